/** Light, dark, or as the system has it; kept in this browser. */

const KEY = "irlfr:theme";
const ORDER = /** @type {const} */ (["auto", "light", "dark"]);
/** @typedef {typeof ORDER[number]} Choice */

/** @type {Record<Choice, string>} */
export const THEME_WORDS = { auto: "automatic", light: "light", dark: "dark" };

/** @returns {Choice} */
export function themeChoice() {
  const chosen = document.documentElement.dataset.theme;
  return chosen === "light" || chosen === "dark" ? chosen : "auto";
}

export function nextTheme() {
  const next = ORDER[(ORDER.indexOf(themeChoice()) + 1) % ORDER.length] ?? "auto";
  if (next === "auto") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = next;
  try {
    if (next === "auto") localStorage.removeItem(KEY);
    else localStorage.setItem(KEY, next);
  } catch {
    // A browser that keeps nothing still shows the theme until the page is left.
  }
}
