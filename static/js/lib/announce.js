/**
 * The one live region of the page (`#announcer` in base.html): what is said here is spoken, politely, once. What lies
 * beneath an open dialog is not there for assistive technology, so a dialog may bring a region of its own.
 */

let pending = "";
/** @type {string[]} */
let news = [];
let timer = 0;

/**
 * Say a sentence to assistive technology. Sentences that come within one breath (80 ms) replace each other, so a
 * fast player hears the last position rather than a queue of old ones.
 * @param {string} sentence
 */
export function announce(sentence) {
  pending = sentence;
  breathe();
}

/** Say a sentence that comes by itself (the server has gone, ten seconds are left): after what is said just now, not in its place. @param {string} sentence */
export function announceToo(sentence) {
  news.push(sentence);
  breathe();
}

function breathe() {
  clearTimeout(timer);
  timer = window.setTimeout(speak, 80);
}

function speak() {
  const region = document.querySelector("dialog[open] [data-announcer]") ?? document.getElementById("announcer");
  const words = [pending, ...news].filter(Boolean).join(" ");
  [pending, news] = ["", []];
  if (!region) return;
  // The same text twice is no change, hence silent; a trailing no-break space makes it new.
  region.textContent = region.textContent === words ? `${words}\u00a0` : words;
}
