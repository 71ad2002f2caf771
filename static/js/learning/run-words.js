/**
 * Runs in words: why one waits, how one stands, and in what its settings differ from the defaults.
 * @import {LearnerInfo, Preset, Run, SettingInfo, WorkerState} from "#js/learning/types.js"
 */
import { listed } from "#js/charts/figures.js";
import { plural } from "#js/lib/format.js";

const MINUTE_MS = 60_000;
const CLOCK = new Intl.DateTimeFormat("en-GB", { hour: "2-digit", minute: "2-digit" });
const CALENDAR = new Intl.DateTimeFormat("en-GB", { day: "numeric", month: "short" });

/**
 * Why a run waits.
 * @param {number | null | undefined} ahead how many come before it
 * @param {WorkerState} [worker]
 */
export function waitingInWords(ahead, worker = "ready") {
  if (worker === "none") return "No worker is running at the moment; your run waits and nothing is lost.";
  if (worker === "warming")
    return "The learners are being warmed up: the first start after an installation takes up to a minute.";
  if (!ahead) return "Your run is next: learning starts in a moment.";
  return `${plural(ahead, "run")} ${ahead === 1 ? "is" : "are"} before yours.`;
}

/**
 * A run's state in a word or two, as it stands in the list.
 * @param {string} status
 * @param {{ share: number, ahead: number | null | undefined, worker?: WorkerState }} how
 */
export function standingInWords(status, { share, ahead, worker }) {
  if (status === "running") return `learning, ${Math.floor(100 * share)} %`;
  if (status !== "queued") return status;
  if (worker === "none") return "waits for a worker";
  if (worker === "warming") return "waits for the warm-up";
  return ahead ? `waits, ${ahead} before it` : "next in line";
}

/**
 * Which preset this is, or in what it differs from the defaults: "Paper", "α 0.5, λ_min 2", "default settings".
 * @param {Pick<Run, "settings">} run
 * @param {SettingInfo[]} settings
 * @param {Preset[]} presets
 */
export function differencesInWords(run, settings, presets) {
  const changed = changedSettings(run.settings, settings);
  const names = Object.keys(changed);
  if (names.length === 0) return "default settings";
  const preset = presets.find((one) => isSame(changedSettings(one.settings, settings), changed));
  if (preset) return `settings of “${preset.title}”`;
  return settings
    .filter(({ name }) => names.includes(name))
    .map(({ name, symbol }) => `${symbol || name.replaceAll("_", " ")} ${valueInWords(changed[name] ?? "")}`)
    .join(", ");
}

/**
 * Those that are not what they are by default.
 * @param {Record<string, number | string>} values
 * @param {SettingInfo[]} settings
 * @returns {Record<string, number | string>}
 */
export function changedSettings(values, settings) {
  const changed = settings.filter(({ name, default: standard }) => name in values && values[name] !== standard);
  return Object.fromEntries(changed.map(({ name }) => [name, values[name] ?? ""]));
}

/**
 * "MEIRL, IRLR and IRLF", as people call them.
 * @param {string[]} names
 * @param {LearnerInfo[]} learners
 */
export function learnersInWords(names, learners) {
  return listed(names.map((name) => learners.find((one) => one.name === name)?.title ?? name.toUpperCase()));
}

/** "just now", "5 minutes ago", "at 14:05", "on 3 May". @param {string} at @param {number} [now] ms since 1970 */
export function agoInWords(at, now = Date.now()) {
  const minutes = Math.floor((now - Date.parse(at)) / MINUTE_MS);
  if (minutes < 1) return "just now";
  if (minutes < 60) return `${plural(minutes, "minute")} ago`;
  const then = new Date(at);
  return minutes < 12 * 60 ? `at ${CLOCK.format(then)}` : `on ${CALENDAR.format(then)}`;
}

/** How long a learner itself computed: "4 ms", "0.31 s", "2 min 5 s". @param {number} ms */
export function durationInWords(ms) {
  if (ms < 100) return `${Math.max(1, Math.round(ms))} ms`;
  if (ms < 99_500) return `${(ms / 1000).toPrecision(2)} s`;
  const seconds = Math.round(ms / 1000);
  return `${Math.floor(seconds / 60)} min ${seconds % 60} s`;
}

/** @param {number | string} value */
function valueInWords(value) {
  return typeof value === "number" ? String(value).replace("-", "−") : value.replaceAll("_", " ");
}

/**
 * @param {Record<string, number | string>} a
 * @param {Record<string, number | string>} b
 */
function isSame(a, b) {
  const names = Object.keys(a);
  return names.length === Object.keys(b).length && names.every((name) => a[name] === b[name]);
}
