/** The one live region of the page (`#announcer` in base.html): what is said here is spoken, politely, once. */

let pending = "";
let timer = 0;

/**
 * Say a sentence to assistive technology. Sentences that come within one breath (80 ms) replace each other, so a
 * fast player hears the last position rather than a queue of old ones.
 * @param {string} sentence
 */
export function announce(sentence) {
  pending = sentence;
  clearTimeout(timer);
  timer = window.setTimeout(speak, 80);
}

function speak() {
  const region = document.getElementById("announcer");
  if (!region) return;
  // The same text twice is no change, hence silent; a trailing no-break space makes it new.
  region.textContent = region.textContent === pending ? `${pending}\u00a0` : pending;
}
