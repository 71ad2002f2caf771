/**
 * The convergence chart in words and as a table: its title, what it means, its text alternative, its figures.
 * @import {FrameStore} from "#js/learning/frame-store.js"
 * @import {LearnerInfo} from "#js/learning/types.js"
 */
import { listed, significant } from "#js/charts/figures.js";

/** @typedef {"gap" | "log_likelihood"} Measure */

const MOST_ROWS = 12;

/** @param {boolean} isOwn false: somebody else played */
function words(isOwn) {
  const [your, you] = isOwn ? ["your", "you"] : ["the player’s", "the player"];
  return {
    gap: {
      title: `Gap to ${your} play (norm of the gradient)`,
      name: "Gap in visits",
      help:
        `The gap is the largest difference, over all squares, between how often the learner expects to come by and how often ${you} did, ` +
        `weighted by ${your} order: ‖μ^π − μ̃‖∞, the size of the gradient that is followed. At zero the learner spends its time exactly as ${your} successes did.`,
    },
    log_likelihood: {
      title: `Log-likelihood of ${your} successes`,
      name: "Log-likelihood",
      help: `How probable ${your} successes are under the learned reward, as a logarithm: the closer to zero, the better it explains them.`,
    },
  };
}

/** @param {Measure} measure @param {boolean} isOwn */
export const measureTitle = (measure, isOwn) => words(isOwn)[measure].title;

/**
 * @param {Measure} measure
 * @param {Pick<LearnerInfo, "title" | "seeks_visits">[]} learners those on the chart
 * @param {boolean} [isOwn]
 */
export function measureHelp(measure, learners, isOwn = true) {
  const { help } = words(isOwn)[measure];
  const others = learners.filter((learner) => !learner.seeks_visits).map(({ title }) => title);
  return others.length > 0 ? `${help} ${aboutOthers(measure, others)}` : help;
}

/**
 * Not every learner descends to the gap, nor climbs the same likelihood.
 * @param {Measure} measure
 * @param {string[]} titles
 */
function aboutOthers(measure, titles) {
  const isOne = titles.length === 1;
  if (measure === "log_likelihood")
    return `${listed(titles)} ${isOne ? "climbs a measure of its own: its line compares" : "climb measures of their own: each of their lines compares"} with itself alone.`;
  return `${listed(titles)} ${isOne ? "seeks something else: its line only tells how differently it walks" : "seek something else: their lines only tell how differently they walk"}.`;
}

/**
 * @param {FrameStore} store
 * @param {Pick<LearnerInfo, "name" | "title">[]} learners
 * @param {Measure} measure
 */
export function chartInWords(store, learners, measure) {
  if (learners.length === 0) return "Nothing has been learned yet.";
  const scale = measure === "gap" ? ", logarithmic scale" : "";
  const lines = learners.map(({ name, title }) => {
    const first = store.at(name, 0);
    const last = store.latest(name);
    return `${title} from ${significant(first?.[measure])} at iteration ${first?.iteration} to ${significant(last?.[measure])} at ${last?.iteration}`;
  });
  return `${words(true)[measure].name} by iteration${scale}: ${lines.join("; ")}.`;
}

/**
 * At most a dozen rows, evenly spread over the recorded iterations.
 * @param {FrameStore} store
 * @param {Pick<LearnerInfo, "name" | "title">[]} learners
 * @param {Measure} measure
 */
export function figuresTable(store, learners, measure) {
  const table = document.createElement("table");
  table.createCaption().textContent = words(true)[measure].name;
  const head = table.createTHead().insertRow();
  for (const text of ["Iteration", ...learners.map(({ title }) => title)]) {
    const cell = document.createElement("th");
    cell.scope = "col";
    cell.textContent = text;
    head.append(cell);
  }
  const body = table.createTBody();
  for (const iteration of spread(store.iterations, MOST_ROWS)) {
    const row = body.insertRow();
    row.insertCell().textContent = String(iteration);
    for (const { name } of learners) row.insertCell().textContent = significant(store.at(name, iteration)?.[measure]);
  }
  return table;
}

/**
 * @param {number[]} values
 * @param {number} most
 */
export function spread(values, most) {
  if (values.length <= most) return values;
  return Array.from({ length: most }, (_, i) => values[Math.round((i * (values.length - 1)) / (most - 1))] ?? 0);
}
