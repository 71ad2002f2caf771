/** The agents of a board: round tokens with two eyes, moved as elements, so that a step paints no canvas. */

import { make, makeSvg, prefersStill } from "#js/board/dom.js";
import { DELTAS, placeOf } from "#js/board/state.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/state.js").Agent} Agent */

const TWEEN_MS = 90;
/** A tween starts one frame in: the first frame painted after a key press already shows the agent on its way. */
const HEAD_START_MS = 1000 / 60;

export class Agents {
  /** @type {Token[]} */
  #tokens = [];

  /** @param {HTMLElement} layer */
  constructor(layer) {
    this.layer = layer;
  }

  /** @param {World} world @param {Agent[]} agents @param {number} cell side of a square in CSS pixels */
  place(world, agents, cell) {
    for (const extra of this.#tokens.splice(agents.length)) extra.element.remove();
    agents.forEach((agent, i) => {
      const token = this.#tokens[i] ?? this.#add();
      token.place(world, agent, cell);
    });
  }

  /** The first agent leans and comes back. @param {number} direction 0…3 */
  lean(direction) {
    const [down, right] = DELTAS[direction] ?? [0, 0];
    this.#tokens[0]?.play([{}, { transform: `translate(${right * 22}%, ${down * 22}%)` }, {}], 140);
  }

  /** The first agent hops, once. */
  hop() {
    this.#tokens[0]?.play([{}, { transform: "translateY(-24%) scale(1.05)" }, {}], 280);
  }

  #add() {
    const token = new Token();
    this.#tokens.push(token);
    this.layer.append(token.element);
    return token;
  }
}

class Token {
  element = make("div", "agent");
  #face = makeFace();
  /** @type {{world: World, agent: Agent, cell: number} | null} */
  #shown = null;
  #from = { x: 0, y: 0 };
  #to = { x: 0, y: 0 };
  /** @type {Animation | null} */
  #tween = null;
  /** @type {Animation | null} */
  #gesture = null;

  constructor() {
    this.element.append(this.#face);
  }

  /** @param {World} world @param {Agent} agent @param {number} cell */
  place(world, agent, cell) {
    const before = this.#shown;
    this.#shown = { world, agent, cell };
    this.#label(agent);
    const isSameBoard = before?.world === world && before.cell === cell;
    if (isSameBoard && before.agent.state === agent.state) return;
    const [row, col] = placeOf(world, agent.state);
    const isStep = isSameBoard && before.agent.who === agent.who && areBeside(world, before.agent.state, agent.state);
    this.#moveTo({ x: col * cell, y: row * cell }, isStep && !prefersStill());
  }

  /** A gesture on the spot; a new one takes the place of the last. @param {Keyframe[]} frames @param {number} duration ms */
  play(frames, duration) {
    if (prefersStill()) return;
    this.#gesture?.cancel();
    this.#gesture = this.#face.animate(frames, { duration, easing: "ease-out" });
  }

  /** @param {Agent} agent */
  #label(agent) {
    const facing = String(agent.facing ?? "");
    const { dataset } = this.element;
    if (dataset.who !== agent.who) dataset.who = agent.who;
    if (dataset.state !== String(agent.state)) dataset.state = String(agent.state);
    if (dataset.facing !== facing) dataset.facing = facing;
  }

  /** From where it is drawn now, be it in the midst of the step before. @param {{x: number, y: number}} to @param {boolean} isTweened */
  #moveTo(to, isTweened) {
    const from = this.#drawn();
    this.#tween?.cancel();
    this.#tween = null;
    this.#from = from;
    this.#to = to;
    this.element.style.transform = translate(to);
    if (!isTweened) return;
    this.#tween = this.element.animate(
      { transform: [translate(from), translate(to)] },
      { duration: TWEEN_MS, easing: "cubic-bezier(0.2, 0.7, 0.3, 1)" },
    );
    this.#tween.startTime = Number(document.timeline.currentTime) - HEAD_START_MS;
  }

  #drawn() {
    const progress = this.#tween?.effect?.getComputedTiming().progress ?? 1;
    const between = (/** @type {number} */ a, /** @type {number} */ b) => a + (b - a) * progress;
    return { x: between(this.#from.x, this.#to.x), y: between(this.#from.y, this.#to.y) };
  }
}

/** @param {World} world @param {number} from @param {number} to */
function areBeside(world, from, to) {
  const [[row, col], [toRow, toCol]] = [placeOf(world, from), placeOf(world, to)];
  return Math.abs(toRow - row) + Math.abs(toCol - col) === 1;
}

/** @param {{x: number, y: number}} place */
function translate({ x, y }) {
  return `translate(${x}px, ${y}px)`;
}

/** The stylesheet turns the eyes where `data-facing` says. */
function makeFace() {
  const eyes = [-2.9, 2.9].map((x) => circle("agent-white", x, -0.6, 2.5));
  const pupils = [-2.9, 2.9].map((x) => circle("agent-pupil", x, -0.6, 1.25));
  return makeSvg(
    "svg",
    { class: "agent-token", viewBox: "-10 -10 20 20" },
    circle("agent-body", 0, 0, 8),
    makeSvg("g", { class: "agent-eyes" }, ...eyes, makeSvg("g", { class: "agent-pupils" }, ...pupils)),
  );
}

/** @param {string} className @param {number} cx @param {number} cy @param {number} r */
function circle(className, cx, cy, r) {
  return makeSvg("circle", { class: className, cx, cy, r });
}
