/** The round token with two eyes, as `board/agents.js` and board.css draw it, for pictures. */

import { placeOf } from "#js/board/state.js";
import { ink } from "#js/pictures/pen.js";
import { place, tag } from "#js/pictures/svg.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/state.js").Agent} Agent */
/** @typedef {import("#js/board/theme.js").Theme} Theme */

/** Half the side of the field the token is drawn in, and how small (pixels) a token may become. */
const HALF = 10;
const SMALLEST = 16;
/** Where eyes and pupils go when the agent looks up, right, down, left (board.css). */
const GLANCES = /** @type {const} */ ([
  { eyes: [0, -2], pupils: [0, -1.1] },
  { eyes: [1.6, 0], pupils: [1.1, 0] },
  { eyes: [0, 2.4], pupils: [0, 1.1] },
  { eyes: [-1.6, 0], pupils: [-1.1, 0] },
]);
const AHEAD = { eyes: [0, 0], pupils: [0, 0] };
const EYES = [-2.9, 2.9];

/** @param {World} world @param {Agent} agent @param {{cell: number, theme: Theme}} how */
export function agentMarkup(world, agent, { cell, theme }) {
  const [row, col] = placeOf(world, agent.state);
  const side = Math.max(cell, SMALLEST);
  return place(token(agent, theme), (col + 0.5) * cell, (row + 0.5) * cell, side / (2 * HALF));
}

/** @param {Agent} agent @param {Theme} theme */
function token({ who, facing }, theme) {
  const { eyes, pupils } = GLANCES[facing ?? -1] ?? AHEAD;
  const isLearner = who !== "human" && who !== "optimal";
  const [white, pupil] = isLearner ? ["#ffffff", "#16191b"] : [theme.agent.white, theme.agent.pupil];
  const body = who === "human" ? theme.agent.human : (theme.who[who] ?? theme.who.random ?? theme.inkDark);
  const round = (
    /** @type {string} */ colour,
    /** @type {number} */ r,
    /** @type {readonly number[]} */ [dx = 0, dy = 0],
  ) => EYES.map((x) => tag("circle", { cx: x + dx, cy: -0.6 + dy, r, fill: ink(colour)[0] })).join("");
  const [paint] = ink(body);
  const [edge] = ink(theme.canvas);
  return (
    tag("circle", { r: 8, fill: paint, stroke: edge, "stroke-width": 0.9 }) +
    round(white, 2.5, eyes) +
    round(pupil, 1.25, [(eyes[0] ?? 0) + (pupils[0] ?? 0), (eyes[1] ?? 0) + (pupils[1] ?? 0)])
  );
}
