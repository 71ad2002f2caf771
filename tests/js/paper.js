/** Colours for pictures that are drawn without a page: those of the light theme. */
import { makeScale, WALKERS } from "#js/board/colours.js";

export const paper = {
  scale: makeScale({ red: [178, 24, 43], middle: [247, 247, 247], blue: [33, 102, 172] }),
  goal: [242, 194, 48],
  wall: [83, 89, 92],
  wallEdge: "#3b4043",
  grid: "#ffffff",
  inkDark: "#16191b",
  inkLight: "#ffffff",
  unknown: "#8b9396",
  accent: "#0f766e",
  canvas: "#ffffff",
  ink: "#1b1f21",
  inkSoft: "#535b5e",
  line: "#dcdfdc",
  font: "sans-serif",
  agent: { human: "#2c3337", white: "#ffffff", pupil: "#16191b" },
  who: Object.fromEntries(Object.keys(WALKERS).map((who, i) => [who, `#0000${(16 + i).toString(16)}`])),
};
