/** What the play page says, each sentence built from plain figures. Failure is welcome: it is counted with the same warmth. */

import { plural, signed } from "#js/lib/format.js";

/**
 * @typedef {object} Finish
 * @property {string} outcome
 * @property {string | null} ending
 * @property {number | null} total     null where totals are not shown
 * @property {number} nSteps
 * @property {number} nSame            attempts of this outcome, this one included
 * @property {number} nWanted
 */

/** @param {Finish} finish @returns {{title: string, text: string}} */
export function finishSentence({ outcome, ending, total, nSteps, nSame, nWanted }) {
  const count = nSame <= nWanted ? `${nSame} of ${nWanted}` : `number ${nSame}`;
  if (outcome === "success") {
    return {
      title: `A success: ${count}`,
      text: `You reached the goal${total === null ? "" : ` with ${signed(total)}`} in ${plural(nSteps, "step")}.`,
    };
  }
  return { title: `A useful failure: ${count}`, text: failureText({ ending, total, nSteps }) };
}

/** @param {Pick<Finish, "ending" | "total" | "nSteps">} finish */
function failureText({ ending, total, nSteps }) {
  const at = total === null ? "" : `, at ${signed(total)}`;
  if (ending === "goal") {
    const cost = "You reached the goal, but the way cost more than the goal gave";
    return total === null ? `${cost}.` : `${cost}: ${signed(total)}.`;
  }
  if (ending === "gave_up") return `You stopped after ${plural(nSteps, "step")}${at}.`;
  if (ending === "out_of_time") return `The time is up after ${plural(nSteps, "step")}${at}.`;
  return `All ${nSteps} steps are used up${at}.`;
}

/** What is still missing before ranking and learning make sense. @param {{nSuccesses: number, nFailures: number, nWanted: number}} counts */
export function missingSentence({ nSuccesses, nFailures, nWanted }) {
  const missing = [
    nSuccesses < nWanted ? plural(nWanted - nSuccesses, "success", "successes") : "",
    nFailures < nWanted ? plural(nWanted - nFailures, "failure") : "",
  ].filter(Boolean);
  if (missing.length === 0) return "Your attempts are complete. Put them in order, or play on.";
  return `${missing.join(" and ")} to go${canRank({ nSuccesses, nFailures }) ? ", or rank now" : ""}.`;
}

/** @param {{nSuccesses: number, nFailures: number}} counts */
export function canRank({ nSuccesses, nFailures }) {
  return nSuccesses >= 1 && nFailures >= 1;
}
