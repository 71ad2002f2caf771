/** Keeps the path at the head of the page (*Play → Rank → Learn → Compare*) in step with what happens on it. */

/** The other pages open once the server has the world. @param {{worldId: string, isSaved: boolean, nSuccesses: number, nFailures: number, nWanted: number}} counts */
export function showCounts({ worldId, isSaved, nSuccesses, nFailures, nWanted }) {
  const isFull = nSuccesses >= nWanted && nFailures >= nWanted;
  setStep("play", {
    state: `${nSuccesses}/${nWanted} ✓ ${nFailures}/${nWanted} ✗`,
    isDone: isFull,
  });
  if (!isSaved) return;
  setStep("play", { href: `/worlds/${worldId}` });
  setStep("rank", { href: `/worlds/${worldId}/rank` });
  setStep("learn", { href: `/worlds/${worldId}/learn` });
}

/** @param {"play" | "rank" | "learn" | "compare"} name @param {{state?: string, isDone?: boolean, href?: string}} change */
export function setStep(name, { state, isDone, href }) {
  const step = document.querySelector(`.path-step[data-step="${name}"]`);
  if (!(step instanceof HTMLElement)) return;
  const words = step.querySelector("[data-path-state]");
  if (words && state !== undefined) words.textContent = state;
  if (isDone !== undefined) step.dataset.done = String(isDone);
  if (href !== undefined) enableLink(step, href);
}

/** Turn a link that led nowhere yet into one that does. @param {Element} link @param {string} href */
export function enableLink(link, href) {
  link.setAttribute("href", href);
  link.removeAttribute("role");
  link.removeAttribute("aria-disabled");
}

/** @param {Element} link */
export function disableLink(link) {
  link.removeAttribute("href");
  link.setAttribute("role", "link");
  link.setAttribute("aria-disabled", "true");
}
