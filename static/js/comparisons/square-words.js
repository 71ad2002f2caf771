/**
 * One square in words, for all who stand on the stage: what the world pays there, and what the boards show of it.
 * @import {Role} from "#js/comparisons/cast.js"
 * @import {ComparePageData} from "#js/comparisons/types.js"
 * @import {Ground} from "#js/comparisons/agent-panel.js"
 */
import { describeSquare } from "#js/board/describe.js";
import { figure } from "#js/charts/figures.js";
import { isLearner } from "#js/comparisons/sentences.js";

/**
 * "Row 3, column 5: red, −3.2. Lost from here on: MEIRL 4.2, IRLR 0.3."
 * @param {ComparePageData} data
 * @param {Role[]} cast
 * @param {number} state
 * @param {Ground} ground
 */
export function squareWords(data, cast, state, ground) {
  const { world, run, comparison } = data;
  const place = describeSquare(world, state);
  if (ground === "true" || world.walls.includes(state)) return place;
  const figures = cast.flatMap(({ entry }) => {
    if (!isLearner(entry)) return [];
    const values = ground === "lost" ? comparison.value_lost?.[entry.who] : run.learners[entry.who]?.reward?.flat();
    return values ? [`${entry.title} ${figure(values[state], ground === "lost" ? 1 : 2)}`] : [];
  });
  if (figures.length === 0) return place;
  return `${place} ${ground === "lost" ? "Lost from here on" : "Learned reward"}: ${figures.join(", ")}.`;
}
