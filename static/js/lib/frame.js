/** What every page shares: the theme, the dialog of keys, the menu of worlds, the link to share. An entry script. */

import { announce } from "#js/lib/announce.js";
import { copyText } from "#js/lib/clipboard.js";
import { isTaken } from "#js/lib/keys.js";
import { nextTheme, THEME_WORDS, themeChoice } from "#js/lib/theme.js";

const share = /** @type {HTMLButtonElement} */ (document.getElementById("share"));
const themeButton = /** @type {HTMLButtonElement} */ (document.getElementById("theme"));
const keys = /** @type {HTMLDialogElement} */ (document.getElementById("keys"));
const menu = /** @type {HTMLDetailsElement} */ (document.getElementById("new-world"));

labelTheme();
themeButton.addEventListener("click", () => {
  nextTheme();
  labelTheme();
  announce(`Theme: ${THEME_WORDS[themeChoice()]}.`);
});

document.getElementById("open-keys")?.addEventListener("click", () => keys.showModal());
keys.addEventListener("click", (event) => {
  if (event.target === keys) keys.close();
});

document.addEventListener("keydown", (event) => {
  if (event.key === "Escape" && menu.open) closeMenu();
  else if (event.key === "?" && !isTaken(event)) {
    event.preventDefault();
    keys.showModal();
  }
});

document.addEventListener("click", (event) => {
  if (menu.open && event.target instanceof Node && !menu.contains(event.target)) menu.open = false;
});

menu.querySelector("form")?.addEventListener("formdata", (event) => {
  const { formData } = event;
  formData.set("cols", String(formData.get("rows")));
  if (formData.get("seed") === "") {
    formData.delete("seed");
    formData.set("new", "");
  }
});

share.addEventListener("click", async () => {
  const word = /** @type {HTMLElement} */ (document.getElementById("share-word"));
  const url = share.dataset.url ?? location.href;
  const isCopied = await copyText(new URL(url, location.href).href);
  word.textContent = isCopied ? "Copied" : "Copy failed";
  share.dataset.told = "true";
  announce(isCopied ? "The link is copied." : "The link could not be copied; it stands in the address bar.");
  setTimeout(() => {
    word.textContent = "Share";
    delete share.dataset.told;
  }, 2000);
});

function closeMenu() {
  menu.open = false;
  menu.querySelector("summary")?.focus();
}

function labelTheme() {
  themeButton.setAttribute("aria-label", `Theme: ${THEME_WORDS[themeChoice()]}`);
  themeButton.title = `Theme: ${THEME_WORDS[themeChoice()]}`;
}
