/** The colours of the board as the stylesheet gives them, read once per theme and kept until it changes. */

import { makeScale, parseColour, WALKERS } from "#js/board/colours.js";

/** @typedef {import("#js/board/colours.js").Rgb} Rgb */

/**
 * @typedef {object} Theme
 * @property {import("#js/board/colours.js").Scale} scale
 * @property {Rgb} goal
 * @property {Rgb} wall
 * @property {string} wallEdge
 * @property {string} grid
 * @property {string} inkDark
 * @property {string} inkLight
 * @property {string} unknown
 * @property {string} accent
 * @property {string} canvas          what halos and pages are made of
 * @property {string} ink             words on it
 * @property {string} inkSoft
 * @property {string} line            hairlines
 * @property {string} font            families
 * @property {{human: string, white: string, pupil: string}} agent
 * @property {Record<string, string>} who
 */

/** @type {Theme | null} */
let current = null;
/** @type {Set<() => void>} */
const listeners = new Set();
let isWatching = false;

/** @returns {Theme} */
export function theme() {
  current ??= readTheme();
  return current;
}

/** The colours of one scheme, whatever the page has on: a picture for paper is light. @param {"light" | "dark"} scheme @returns {Theme} */
export function themeIn(scheme) {
  return readTheme(scheme);
}

/** Call back when light turns dark or the other way. @param {() => void} listener @param {AbortSignal} signal */
export function onThemeChange(listener, signal) {
  if (!isWatching) watch();
  listeners.add(listener);
  signal.addEventListener("abort", () => listeners.delete(listener));
}

function watch() {
  isWatching = true;
  for (const query of ["(prefers-color-scheme: dark)", "(forced-colors: active)"]) {
    matchMedia(query).addEventListener("change", changed);
  }
  new MutationObserver(changed).observe(document.documentElement, { attributeFilter: ["data-theme"] });
}

function changed() {
  current = null;
  for (const listener of listeners) listener();
}

/** @param {"light" | "dark" | ""} [scheme] that of the page unless given @returns {Theme} */
function readTheme(scheme = "") {
  // A custom property keeps its `light-dark()` unresolved; the colour of an element does not.
  const probe = document.createElement("i");
  probe.hidden = true;
  probe.style.colorScheme = scheme;
  // The colours of the board are its data: a forced palette must not flatten them.
  probe.style.setProperty("forced-color-adjust", "none");
  document.body.append(probe);
  const read = (/** @type {string} */ token) => {
    probe.style.color = `var(${token})`;
    return getComputedStyle(probe).color;
  };
  const found = {
    scale: makeScale({
      red: parseColour(read("--reward-red")),
      middle: parseColour(read("--reward-middle")),
      blue: parseColour(read("--reward-blue")),
    }),
    goal: parseColour(read("--board-goal")),
    wall: parseColour(read("--board-wall")),
    wallEdge: read("--board-wall-edge"),
    grid: read("--board-grid"),
    inkDark: read("--board-ink-dark"),
    inkLight: read("--board-ink-light"),
    unknown: read("--board-unknown"),
    accent: read("--color-accent"),
    canvas: read("--color-surface"),
    ink: read("--color-ink"),
    inkSoft: read("--color-ink-soft"),
    line: read("--color-line"),
    font: getComputedStyle(probe).fontFamily,
    agent: { human: read("--agent-human"), white: read("--agent-white"), pupil: read("--agent-pupil") },
    who: Object.fromEntries(Object.entries(WALKERS).map(([who, { token }]) => [who, read(token)])),
  };
  probe.remove();
  return found;
}
