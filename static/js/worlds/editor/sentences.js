/** What the editor says, each sentence built from plain figures. */

import { describeSquare } from "#js/board/describe.js";
import { nextState } from "#js/board/state.js";
import { plural } from "#js/lib/format.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/worlds/editor/brushes.js").Tool} Tool */
/** @typedef {{state: "checking" | "possible" | "hopeless" | "refused" | "gone", text: string}} Verdict */

/** @type {Record<Tool, string>} */
export const TOOL_HINTS = {
  wall: "Draw walls. Press one again to open it.",
  paint: "",
  goal: "",
  start: "Press the square where attempts begin.",
  erase: "Give squares back as they were drawn.",
  pick: "Press a square to go on with what it is.",
};

export const GONE =
  "The server cannot be reached just now, so this world is not checked yet. Paint on: nothing is lost.";
export const TOO_LARGE =
  "So many squares are painted that this world is not checked while you paint. It is checked when you play or share it.";
const SHUT = "Walls close every way from the start to a goal. Open one of them.";

/**
 * What can be told to be impossible without asking the server; its own words come when it has to be asked.
 * @param {{rows: number, cols: number, stepLimit: number | null}} plan
 * @param {number | null} nSteps the shortest way
 * @returns {{message: string, fields: Record<string, string>} | null}
 */
export function refusalOf({ rows, cols, stepLimit }, nSteps) {
  if (nSteps === null) return { message: SHUT, fields: { walls: SHUT } };
  const most = 2 * rows * cols;
  if (stepLimit === null || (stepLimit >= nSteps && stepLimit <= most)) return null;
  const message = `The step limit can be from ${nSteps}, the shortest way, to ${most}: twice the squares.`;
  return { message, fields: { step_limit: message } };
}

/** Steps from the start to the nearest goal, or null where there is no way. @param {World} world */
export function shortestWay(world) {
  const isGoal = new Set(world.goals);
  const open = { ...world, walls: [] };
  const isSeen = new Uint8Array(world.rows * world.cols);
  for (const square of [world.start, ...world.walls]) isSeen[square] = 1;
  let nSteps = 0;
  for (let frontier = [world.start]; frontier.length > 0; nSteps++) {
    if (frontier.some((square) => isGoal.has(square))) return nSteps;
    /** @type {number[]} */
    const ahead = [];
    for (const square of frontier) {
      for (let way = 0; way < 4; way++) {
        const next = nextState(open, square, way);
        if (isSeen[next]) continue;
        isSeen[next] = 1;
        ahead.push(next);
      }
    }
    frontier = ahead;
  }
  return null;
}

/** Whether a success is possible, of a world the server has looked at. @param {World} world @param {boolean} isLimited somebody set a step limit @returns {Verdict} */
export function verdictOf(world, isLimited) {
  if (world.success_possible !== false) {
    const luck = world.slip > 0 ? ", with luck where it slips" : "";
    return { state: "possible", text: `A success is possible${luck}.` };
  }
  const goal = world.goals.length > 1 ? "a goal" : "the goal";
  const [within, more] = isLimited ? [` within ${plural(world.horizon, "step")}`, ", or allow more steps"] : ["", ""];
  const cure = `Make red squares rarer, paint a cheaper way, let ${goal} pay more${more}.`;
  return {
    state: "hopeless",
    text: `In this world no success is possible: every way${within} costs more than ${goal} pays. ${
      more ? cure : cure.replace(", let", ", or let")
    }`,
  };
}

/** How long an attempt may be. @param {{horizon: number | null, timeLimitS: number | null}} limits */
export function limitWords({ horizon, timeLimitS }) {
  const steps = horizon === null ? "…" : plural(horizon, "step");
  return timeLimitS === null ? steps : `${steps}, ${plural(timeLimitS, "second")}`;
}

/** "Row 3, column 4: red, −3.2. Painted." @param {World} world @param {number} square @param {boolean} isPainted */
export function squareSentence(world, square, isPainted) {
  return describeSquare(world, square) + (isPainted ? " Painted." : "");
}
