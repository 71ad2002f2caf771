/** The groups of an order on a line, as far apart as was said; dashed where nothing was said. */

import { make } from "#js/board/dom.js";
import { scaleOf } from "#js/rankings/magnitude.js";

/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/sitting-state.js").Gap} Gap */

/** Of more stops than these each is drawn smaller. */
const ROOMY = 14;

/** @param {HTMLElement} host @param {Order} order @param {readonly Gap[]} gaps */
export function drawScale(host, order, gaps) {
  const { stops, spans } = scaleOf(order, gaps);
  const lines = spans.map(({ from, to, value }) => {
    const line = make("span", "scale-span");
    line.dataset.said = String(value !== null);
    line.style.insetInlineStart = `${from}%`;
    line.style.inlineSize = `${to - from}%`;
    return line;
  });
  const dots = stops.map(({ rank, n, at, isLabelled }) => {
    const dot = make("span", "scale-stop");
    dot.style.insetInlineStart = `${at}%`;
    dot.dataset.label = isLabelled ? `${rank}${n > 1 ? "=" : ""}` : "";
    return dot;
  });
  host.dataset.isDense = String(stops.length > ROOMY);
  host.replaceChildren(...lines, ...dots);
  host.setAttribute("aria-label", scaleWords(stops, spans));
}

/** "Place 1, then 70 to place 2, then not said to place 3". @param {{rank: number}[]} stops @param {{value: number | null}[]} spans */
function scaleWords(stops, spans) {
  const steps = spans.map(({ value }, i) => `${value ?? "not said"} to place ${stops[i + 1]?.rank}`);
  return ["Distances as you said them: place 1", ...steps].join(", ");
}
