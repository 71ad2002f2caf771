import assert from "node:assert/strict";
import test from "node:test";
import { PLAYBACK_MS, Timeline } from "#js/learning/timeline.js";

const timelineOf = (last) => {
  const timeline = new Timeline();
  timeline.extendTo(last);
  return timeline;
};

test("it follows the newest iteration until it is held", () => {
  const timeline = timelineOf(40);
  assert.equal(timeline.position, 40);
  timeline.moveTo(10);
  timeline.extendTo(80);
  assert.equal(timeline.position, 10);
  assert.equal(timeline.isFollowing, false);
});

test("moved to the end it follows again", () => {
  const timeline = timelineOf(40);
  timeline.moveTo(10);
  timeline.moveTo(99);
  timeline.extendTo(80);
  assert.equal(timeline.position, 80);
});

test("playing from the end starts over and ends at the end", () => {
  const timeline = timelineOf(500);
  timeline.play();
  assert.equal(timeline.position, 0);
  timeline.advance(PLAYBACK_MS / 2);
  assert.equal(timeline.position, 250);
  timeline.advance(PLAYBACK_MS);
  assert.equal(timeline.position, 500);
  assert.equal(timeline.isPlaying, false);
});

test("paused it stays where it is", () => {
  const timeline = timelineOf(500);
  timeline.play();
  timeline.advance(PLAYBACK_MS / 4);
  timeline.pause();
  timeline.advance(PLAYBACK_MS);
  assert.equal(timeline.position, 125);
});

test("with nothing recorded there is nothing to play", () => {
  const timeline = new Timeline();
  timeline.play();
  assert.equal(timeline.isPlaying, false);
});
