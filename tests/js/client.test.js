import assert from "node:assert/strict";
import test from "node:test";
import { agentClass, refreshRate } from "#js/worlds/client.js";

const AGENTS = {
  "Mozilla/5.0 (X11; Linux x86_64) AppleWebKit/537.36 (KHTML, like Gecko) Chrome/140.0 Safari/537.36":
    "desktop Chromium",
  "Mozilla/5.0 (Windows NT 10.0; Win64; x64; rv:140.0) Gecko/20100101 Firefox/140.0": "desktop Firefox",
  "Mozilla/5.0 (Macintosh; Intel Mac OS X 10_15) AppleWebKit/605.1 (KHTML, like Gecko) Version/18 Safari/605.1":
    "desktop Safari",
  "Mozilla/5.0 (iPhone; CPU iPhone OS 18_0 like Mac OS X) AppleWebKit/605.1 Version/18 Mobile/15E Safari/604.1":
    "phone Safari",
  "Mozilla/5.0 (iPhone; CPU iPhone OS 18_0 like Mac OS X) AppleWebKit/605.1 CriOS/140 Mobile/15E Safari/604.1":
    "phone Chromium",
  "Mozilla/5.0 (Linux; Android 15; Pixel 9) AppleWebKit/537.36 Chrome/140.0 Mobile Safari/537.36": "phone Chromium",
  "Mozilla/5.0 (Linux; Android 15; SM-X910) AppleWebKit/537.36 Chrome/140.0 Safari/537.36": "tablet Chromium",
  "Mozilla/5.0 (Android 15; Mobile; rv:140.0) Gecko/140.0 Firefox/140.0": "phone Firefox",
  "a browser of my own": "desktop other",
};

for (const [userAgent, words] of Object.entries(AGENTS)) {
  test(`the class of ${userAgent.slice(0, 60)} is ${words}`, () => assert.equal(agentClass({ userAgent }), words));
}

test("an iPad that calls itself a Mac is a tablet", () => {
  const userAgent = "Mozilla/5.0 (Macintosh; Intel Mac OS X 10_15) AppleWebKit/605.1 Version/18 Safari/605.1";
  assert.equal(agentClass({ userAgent, maxTouchPoints: 5 }), "tablet Safari");
});

test("the refresh rate is the middle of the frames, whatever one slow frame did", () => {
  const times = Array.from({ length: 20 }, (_, i) => (i * 1000) / 60 + (i > 10 ? 300 : 0));
  assert.equal(refreshRate(times), 60);
});

test("a few frames say nothing about the rate", () => {
  assert.equal(refreshRate([0, 16, 33]), null);
});

test("no screen has a million frames a second", () => {
  assert.equal(refreshRate(Array.from({ length: 20 }, (_, i) => i / 1000)), null);
});
