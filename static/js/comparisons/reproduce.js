/**
 * The command that computes a run again from its demonstration file.
 * @import {Run, SettingInfo} from "#js/learning/types.js"
 */

/**
 * @param {Pick<Run, "id" | "seed" | "learners" | "settings">} run
 * @param {Record<string, number | string>} defaults
 */
export function reproduceCommand(run, defaults) {
  const changed = Object.entries(run.settings)
    .filter(([name, value]) => name in defaults && value !== defaults[name])
    .map(([name, value]) => `--set ${name}=${value}`);
  const learners = Object.keys(run.learners).join(",");
  return ["irlfr learn", fileName(run), `--seed ${run.seed}`, `--learners ${learners}`, ...changed].join(" ");
}

/** @param {Pick<Run, "id">} run */
export function fileName(run) {
  return `irlfr-${run.id.slice(0, 8)}.jsonl`;
}
