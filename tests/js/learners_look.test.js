import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { luminance, markerPath, parseColour, toOklab, WALKERS, walker } from "#js/board/colours.js";
import { fitted, layOutDotPlot } from "#js/charts/dot-plot-layout.js";
import { columnsFor } from "#js/learning/columns.js";

const css = readFileSync(new URL("../../static/css/tokens.css", import.meta.url), "utf8");
const BASELINE = "--who-baseline";

/** The light and the dark value of a token. */
function themes(token) {
  const found = new RegExp(`${token}: light-dark\\((#[0-9a-f]{6}), (#[0-9a-f]{6})\\)`).exec(css);
  assert.ok(found, `${token} is in tokens.css`);
  return [parseColour(found[1]), parseColour(found[2])];
}

function contrast(one, other) {
  const [dark, light] = [luminance(one), luminance(other)].sort((a, b) => a - b);
  return (light + 0.05) / (dark + 0.05);
}

test("every learner's hue holds 3:1 on every ground, light and dark", () => {
  for (const { token, title } of [...Object.values(WALKERS), walker("nobody knows it")]) {
    for (const ground of ["--color-canvas", "--color-surface"]) {
      themes(token).forEach((hue, i) => {
        const found = contrast(hue, themes(ground)[i]);
        assert.ok(found >= 3, `${title} on ${ground}: ${found.toFixed(2)}`);
      });
    }
  }
});

test("no two of those who walk share a shape; hues differ but for the baselines'", () => {
  const walkers = Object.values(WALKERS);
  assert.equal(new Set(walkers.map(({ shape }) => markerPath(shape))).size, walkers.length);
  const hues = [...new Set(walkers.map(({ token }) => token))];
  assert.deepEqual(walkers.filter(({ token }) => token === BASELINE).length, 4);
  for (const mode of [0, 1]) {
    const colours = hues.map((token) => toOklab(themes(token)[mode]));
    for (const [i, a] of colours.entries()) {
      for (const [j, b] of colours.entries()) {
        if (i < j) assert.ok(Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) > 0.06, `${hues[i]} and ${hues[j]}`);
      }
    }
  }
});

test("boards stand in rows of equal length, or nearly", () => {
  assert.deepEqual(
    [1, 5, 6, 7, 10, 12, 13].map((count) => columnsFor(count)),
    [1, 5, 6, 4, 5, 6, 5],
  );
  assert.equal(columnsFor(7, 7), 7);
});

test("a long title is cut on the dot plot, a short one is whole", () => {
  const entry = { who: "score_irl", title: "Score-based IRL (uses scores)", mean_return: 1, standard_error: 0 };
  const { left } = layOutDotPlot([{ ...entry, expected_return: 1, greedy_return: 1 }], 320);
  assert.equal(fitted(entry.title, left), "Score-based…");
  assert.equal(fitted("MEIRL", left), "MEIRL");
});
