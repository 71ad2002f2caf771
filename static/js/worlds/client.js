/** What a record says about the device an attempt was played on: kinds and sizes, nothing that names a person. */

const FRAMES_WATCHED = 40;
/** Frames that come faster are no screen's: a clock that lies, or frames made up by a test. */
const SHORTEST_PAUSE_MS = 1;

/** "desktop Chromium", "phone Safari", …: a class, not the user agent. @param {{userAgent: string, maxTouchPoints?: number}} agent */
export function agentClass({ userAgent, maxTouchPoints = 0 }) {
  const isIpad = /Macintosh/.test(userAgent) && maxTouchPoints > 1;
  const isTablet = isIpad || /iPad|Tablet|Android(?!.*Mobile)/.test(userAgent);
  const kind = isTablet ? "tablet" : /Mobi|iPhone|Android/.test(userAgent) ? "phone" : "desktop";
  return `${kind} ${engineOf(userAgent)}`;
}

/** @param {string} userAgent */
function engineOf(userAgent) {
  if (/Firefox|FxiOS/.test(userAgent)) return "Firefox";
  if (/Chrom(e|ium)|CriOS/.test(userAgent)) return "Chromium";
  return /Safari/.test(userAgent) ? "Safari" : "other";
}

/** The middle of the pauses between frames, as frames a second; null where there are too few, or no screen has so many. @param {readonly number[]} times ms */
export function refreshRate(times) {
  const pauses = times.slice(1).map((time, i) => time - (times[i] ?? 0));
  if (pauses.length < 8) return null;
  const middle = pauses.sort((a, b) => a - b)[pauses.length >> 1] ?? 0;
  return middle >= SHORTEST_PAUSE_MS ? Math.round(10_000 / middle) / 10 : null;
}

export class Client {
  /** @type {number[]} */
  #frames = [];
  #options;

  /** @param {{showTotals: boolean, holdToMove: boolean}} options  of the study */
  constructor({ showTotals, holdToMove }) {
    this.#options = { totals_shown: showTotals, hold_to_move: holdToMove };
    requestAnimationFrame((time) => this.#watch(time));
  }

  /** As it is just now. */
  describe() {
    const is = (/** @type {string} */ query) => matchMedia(query).matches;
    return {
      agent: agentClass(navigator),
      // Whole numbers, whatever a browser makes of them when zoomed.
      viewport: [Math.round(window.innerWidth), Math.round(window.innerHeight)],
      pixel_ratio: window.devicePixelRatio,
      refresh_hz: refreshRate(this.#frames),
      pointer: is("(pointer: coarse)") ? "coarse" : "fine",
      reduced_motion: is("(prefers-reduced-motion: reduce)"),
      forced_colours: is("(forced-colors: active)"),
      dark: getComputedStyle(document.documentElement).colorScheme === "dark" || isSystemDark(is),
      ...this.#options,
    };
  }

  /** @param {number} time */
  #watch(time) {
    this.#frames.push(time);
    if (this.#frames.length < FRAMES_WATCHED) requestAnimationFrame((next) => this.#watch(next));
  }
}

/** @param {(query: string) => boolean} is */
function isSystemDark(is) {
  return document.documentElement.dataset.theme === undefined && is("(prefers-color-scheme: dark)");
}
