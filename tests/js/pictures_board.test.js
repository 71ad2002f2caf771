import assert from "node:assert/strict";
import test from "node:test";
import { lookOf } from "#js/board/render.js";
import { EMPTY_VIEW } from "#js/board/state.js";
import { boardSvg } from "#js/pictures/board.js";
import { legendSvg } from "#js/pictures/legend.js";
import { hex, ink } from "#js/pictures/pen.js";
import { boardPicture } from "#js/pictures/picture.js";
import { brokenInto, fittedInto, textWidth } from "#js/pictures/text-width.js";
import { makeWorld } from "./factories.js";
import { paper as theme } from "./paper.js";

const world = makeWorld(
  [
    [-0.2, -3.5, -0.9],
    [-0.4, -0.1, -6],
    [-0.3, -0.5, 6],
  ],
  { walls: [4] },
);

test("every square has the colour it has on the page", () => {
  const svg = boardSvg(world, {}, { cell: 20, theme });
  const { pixels } = lookOf(world, EMPTY_VIEW, theme);
  for (let state = 0; state < 9; state++) {
    const [x, y] = [(state % 3) * 20, Math.floor(state / 3) * 20];
    const square = new RegExp(`d="[^"]*M${x} ${y}h20v20[^"]*" fill="(#[0-9a-f]{6})"`).exec(svg);
    assert.equal(square?.[1], hex(pixels.data.subarray(4 * state, 4 * state + 3)), `square ${state}`);
  }
});

test("a picture holds what its view holds: figures, arrows, visits, hatch, paths, agents", () => {
  const bare = boardSvg(world, {}, { cell: 40, theme });
  const layers = {
    numbers: true,
    arrows: Array(9).fill([0.25, 0.25, 0.25, 0.25]),
    visits: Array(9).fill(1),
    unknown: Array(9).fill(true),
    paths: [{ states: [0, 1, 2, 5], who: "irlr" }],
    agents: [{ state: 3, who: "irlf", facing: 1 }],
  };
  for (const [name, value] of Object.entries(layers)) {
    const more = boardSvg(world, { [name]: value }, { cell: 40, theme });
    assert.ok(more.length > bare.length + 60, name);
  }
  assert.match(boardSvg(world, { numbers: true }, { cell: 40, theme }), /font-weight="600"[^>]*>−3\.5</);
  assert.ok(boardSvg(world, { paths: layers.paths }, { theme }).includes(`stroke="${theme.who.irlr}"`));
  assert.ok(boardSvg(world, { agents: layers.agents }, { theme }).includes(`fill="${theme.who.irlf}"`));
});

test("a picture is plain SVG: no styles, no colour that an old reader does not know, no number that is not one", () => {
  const view = { values: [1, -2, 0, 3, 0, -1, 0.5, 0, 1], numbers: true, arrows: Array(9).fill([0.7, 0.1, 0.1, 0.1]) };
  const svg = boardPicture(world, view, { title: "Rewards & <arrows>", note: "A note.", theme });
  assert.doesNotMatch(svg, /style=|class=|rgb|NaN|undefined|Infinity|null/);
  assert.match(svg, /<title>Rewards &#38; &#60;arrows&#62;<\/title>/);
  assert.match(svg, /A note\. World of 3 × 3 squares, seed 1, with walls\./);
});

test("a legend names only what is on the board", () => {
  const words = (view) =>
    [...legendSvg(world, view, { theme }).matchAll(/>([^<>]+)<\/text>/g)].map(([, found]) => found);
  assert.deepEqual(words({}), ["0 to −1 a step", "−1 to −7, hatched", "goal +6", "wall", "start"]);
  const learned = words({ values: [-2, 1, 0, 0, 0, 0, 0, 0, 1], unknown: Array(9).fill(true) });
  assert.deepEqual(learned, ["−2.0", "+2.0 learned reward, on a scale of its own", "start", "no attempt came here"]);
  const lost = boardPicture(
    world,
    { values: [-3, ...Array(8).fill(0)] },
    { title: "Lost", values: "reward lost", theme },
  );
  assert.match(lost, />−3\.0<.*>0 reward lost</);
});

test("inks are written as six digits and an opacity", () => {
  assert.deepEqual(ink("rgb(255, 0, 16)"), ["#ff0010", undefined]);
  assert.deepEqual(ink("rgb(255 0 16 / 0.5)", 0.5), ["#ff0010", 0.25]);
  assert.deepEqual(ink("#1b1f21", 0.9), ["#1b1f21", 0.9]);
});

test("lines break where they would be wider than their place", () => {
  const words = "IRLFR earned more than the player in this world";
  const lines = brokenInto(words, 120, 12);
  assert.ok(lines.length > 1);
  assert.ok(lines.every((line) => textWidth(line, 12) <= 120));
  assert.equal(lines.join(" "), words);
  assert.ok(textWidth(fittedInto(words, 100, 12), 12) <= 100);
});
