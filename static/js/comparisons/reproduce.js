/**
 * The command that computes a run again from its demonstration file. Every setting is named, also those at their default,
 * so that the command still gives the same when a default changes.
 * @import {Run} from "#js/learning/types.js"
 */

/** @param {Pick<Run, "id" | "seed" | "learners" | "settings">} run */
export function reproduceCommand(run) {
  const learners = Object.keys(run.learners).join(",");
  const settings = Object.entries(run.settings).map(([name, value]) => `--set ${name}=${value}`);
  return ["irlfr learn", fileName(run), `--seed ${run.seed}`, `--learners ${learners}`, ...settings].join(" ");
}

/** @param {Pick<Run, "id">} run */
export function fileName(run) {
  return `irlfr-${run.id.slice(0, 8)}.jsonl`;
}
