/** What the play page says, each sentence built from plain figures. Failure is welcome: it is counted with the same warmth. */

import { plural, signed } from "#js/lib/format.js";

/** @typedef {{outcome: string, ending: string | null, total: number, nSteps: number, nSame: number, nWanted: number}} Finish */

/** @param {Finish} finish @returns {{title: string, text: string}} */
export function finishSentence({ outcome, ending, total, nSteps, nSame, nWanted }) {
  const count = nSame <= nWanted ? `${nSame} of ${nWanted}` : `number ${nSame}`;
  if (outcome === "success") {
    return {
      title: `A success: ${count}`,
      text: `You reached the goal with ${signed(total)} in ${plural(nSteps, "step")}.`,
    };
  }
  return { title: `A useful failure: ${count}`, text: failureText({ ending, total, nSteps }) };
}

/** @param {{ending: string | null, total: number, nSteps: number}} finish */
function failureText({ ending, total, nSteps }) {
  if (ending === "goal") return `You reached the goal, but the way cost more than the goal gave: ${signed(total)}.`;
  if (ending === "gave_up") return `You stopped after ${plural(nSteps, "step")}, at ${signed(total)}.`;
  return `All ${nSteps} steps are used up, at ${signed(total)}.`;
}

/** What is still missing before ranking and learning make sense. @param {{nSuccesses: number, nFailures: number, nWanted: number}} counts */
export function missingSentence({ nSuccesses, nFailures, nWanted }) {
  const missing = [
    nSuccesses < nWanted ? plural(nWanted - nSuccesses, "success", "successes") : "",
    nFailures < nWanted ? plural(nWanted - nFailures, "failure") : "",
  ].filter(Boolean);
  if (missing.length === 0) return "Your attempts are complete. Put them in order, or play on.";
  const text = `${missing.join(" and ")} to go.`;
  return canRank({ nSuccesses, nFailures }) ? `${text} You can rank already.` : text;
}

/** @param {{nSuccesses: number, nFailures: number}} counts */
export function canRank({ nSuccesses, nFailures }) {
  return nSuccesses >= 1 && nFailures >= 1;
}
