/**
 * What one has to know to read this comparison rightly: learners that diverged, material that says little.
 * @import {ComparePageData} from "#js/comparisons/types.js"
 * @import {Voice} from "#js/comparisons/voice.js"
 */
import { listed } from "#js/charts/figures.js";

/** @param {ComparePageData} data @param {Voice} voice @returns {string[]} */
export function remarks(data, voice) {
  return [...aboutLearning(data), ...aboutMaterial(data, voice)];
}

/** @param {ComparePageData} data */
function aboutLearning({ run, learners }) {
  const diverged = learners.filter(({ name }) => run.learners[name]?.outcome === "diverged").map(({ title }) => title);
  if (diverged.length === 0) return [];
  return [
    `${listed(diverged)} diverged: measured here are the last figures that were still finite. A smaller learning rate may help.`,
  ];
}

/** @param {ComparePageData} data @param {Voice} voice */
function aboutMaterial({ demonstrations, rankings }, { Your, your }) {
  const found = [];
  const ofOutcome = (/** @type {string} */ outcome) => demonstrations.filter((one) => one.outcome === outcome);
  if (demonstrations.length > 0 && ofOutcome("success").length === 0)
    found.push(`None of ${your} attempts is a success, so only learners that can do without one are here.`);
  if (areAllAlike(demonstrations))
    found.push(`${Your} ${demonstrations.length} attempts are all the same walk: they say as much as one.`);
  const tied = /** @type {const} */ (["success", "failure"]).filter((outcome) => isOneTie(rankings[outcome]?.order));
  const names = tied.map((outcome) => ({ success: "successes", failure: "failures" })[outcome]);
  if (names.length > 0)
    found.push(`${Your} ${listed(names)} are all tied, so their order tells no learner which was better.`);
  return found;
}

/** @param {{ states: number[] }[]} demonstrations */
function areAllAlike(demonstrations) {
  return demonstrations.length > 1 && new Set(demonstrations.map(({ states }) => states.join())).size === 1;
}

/** @param {string[][] | undefined} order */
function isOneTie(order) {
  return order?.length === 1 && (order[0]?.length ?? 0) > 1;
}
