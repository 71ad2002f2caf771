/**
 * Cards dragged by mouse, pen or finger. Nothing but the card moves until it is let go: a mark shows where it would land,
 * every weight what it would become. A mouse drags by anything but buttons; a finger by the small board, so that the rest
 * of a card scrolls the page.
 */

import { boxOf } from "#js/rankings/group-list.js";
import { ASIDE, landingOf, pushOf } from "#js/rankings/landing.js";
import { LandingMarks } from "#js/rankings/landing-marks.js";
import { place } from "#js/rankings/order.js";

/** @typedef {import("#js/rankings/card.js").Card} Card */
/** @typedef {import("#js/rankings/group-list.js").GroupList} GroupList */
/** @typedef {import("#js/rankings/landing.js").Landing} Landing */
/** @typedef {import("#js/rankings/landing.js").Point} Point */
/** @typedef {import("#js/rankings/order.js").Place} Place */
/** @typedef {import("#js/rankings/sitting-state.js").Means} Means */

/**
 * @typedef {object} Hands
 * @property {(element: Element | null) => {card: Card, list: GroupList} | null} find
 * @property {() => void} drop                                         what the keyboard holds
 * @property {(card: Card, where: Place, means: Means) => void} land
 * @property {(card: Card) => void} sayPutBack
 * @property {(card: Card, means: Means) => void} tap
 */

/** @typedef {{card: Card, list: GroupList, pointerId: number, means: Means, isGrip: boolean, from: Point, start: Point, at: Point}} Press   from: on the page; start, at: in the window */
/** @typedef {{home: import("#js/rankings/landing.js").Box, groups: import("#js/rankings/landing.js").GroupBox[], wentAside: boolean, landing: Landing | null, marks: LandingMarks}} Flight */

/** A hand that only presses trembles less than this, in CSS pixels. */
const TREMOR = { mouse: 4, touch: 8, pen: 6 };
const SCROLL_PX_PER_MS = 1.4;

export class CardDrag {
  #hands;
  #life = new AbortController();
  /** @type {Press | null} */
  #press = null;
  /** @type {Flight | null} */
  #flight = null;

  /** @param {Hands} hands */
  constructor(hands) {
    this.#hands = hands;
  }

  /** @param {HTMLElement} root @param {AbortSignal} signal */
  listen(root, signal) {
    root.addEventListener("pointerdown", (event) => this.#onDown(event), { signal });
  }

  get isFlying() {
    return this.#flight !== null;
  }

  /** The lists have changed under the hand: nothing comes of this drag. */
  abandon() {
    this.#flight?.marks.hide();
    this.#end();
  }

  /** @param {PointerEvent} event */
  #onDown(event) {
    const target = event.target instanceof Element ? event.target : null;
    const found = this.#hands.find(target);
    const isGrip = target?.closest(".card-grip") != null;
    const isOurs = event.isPrimary && event.button === 0 && !target?.closest("button");
    if (!found || !isOurs || this.#press || (event.pointerType !== "mouse" && !isGrip)) return;
    const at = { x: event.clientX, y: event.clientY };
    const means = /** @type {"mouse" | "touch" | "pen"} */ (event.pointerType);
    this.#press = { ...found, pointerId: event.pointerId, means, isGrip, from: onPage(at), start: at, at };
    this.#watch();
  }

  /** From the press to its end. */
  #watch() {
    this.#life = new AbortController();
    const options = { signal: this.#life.signal };
    const ifOurs = (/** @type {(event: PointerEvent) => void} */ act) => (/** @type {PointerEvent} */ event) => {
      if (event.pointerId === this.#press?.pointerId) act(event);
    };
    document.addEventListener(
      "pointermove",
      ifOurs((event) => this.#onMove(event)),
      options,
    );
    document.addEventListener(
      "pointerup",
      ifOurs(() => this.#onUp()),
      options,
    );
    document.addEventListener(
      "pointercancel",
      ifOurs(() => this.#putBack()),
      options,
    );
    document.addEventListener("keydown", (event) => this.#onKey(event), { ...options, capture: true });
    window.addEventListener("blur", () => this.#putBack(), options);
    window.addEventListener("scroll", () => this.#follow(), options);
    window.addEventListener("resize", () => this.#measureAgain(), options);
  }

  /** @param {PointerEvent} event */
  #onMove({ clientX, clientY }) {
    const press = /** @type {Press} */ (this.#press);
    press.at = { x: clientX, y: clientY };
    const { x, y } = shift(press);
    if (!this.#flight && Math.hypot(x, y) > TREMOR[/** @type {"mouse"} */ (press.means)]) this.#takeOff(press);
    this.#follow();
  }

  /** @param {Press} press */
  #takeOff({ card, list, pointerId }) {
    this.#hands.drop();
    const groups = list.measure();
    const marks = new LandingMarks(/** @type {HTMLElement} */ (list.list.parentElement));
    this.#flight = { home: boxOf(card.element), groups, wentAside: false, landing: null, marks };
    card.element.setPointerCapture(pointerId);
    document.documentElement.dataset.dragging = "true";
    requestAnimationFrame((time) => this.#scroll(time));
  }

  #follow() {
    const [press, flight] = [this.#press, this.#flight];
    if (!press || !flight) return;
    const { card, list } = press;
    const by = shift(press);
    list.fly(card.id, by);
    flight.wentAside ||= Math.abs(by.x) > ASIDE;
    const how = { id: card.id, box: flight.home, wentAside: flight.wentAside };
    flight.landing = landingOf(onPage(press.at), flight.groups, how);
    list.preview(flight.landing && place(list.order, card.id, flight.landing));
    flight.marks.show(flight);
  }

  /** Held near an end of the window, the page scrolls. @param {number} before */
  #scroll(before) {
    requestAnimationFrame((time) => {
      const press = this.#press;
      if (!this.#flight || !press) return;
      const push = pushOf(press.at.y, { from: press.start.y, ...sight() });
      if (push !== 0) {
        window.scrollBy({ top: push * SCROLL_PX_PER_MS * Math.min(50, time - before), behavior: "instant" });
        this.#follow();
      }
      this.#scroll(time);
    });
  }

  #onUp() {
    const [press, flight] = [/** @type {Press} */ (this.#press), this.#flight];
    if (!flight) {
      this.#end();
      if (press.isGrip) this.#hands.tap(press.card, press.means);
    } else if (flight.landing) {
      this.abandon();
      const { group, joins } = flight.landing;
      this.#hands.land(press.card, { group, joins }, press.means);
    } else this.#putBack();
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    if (event.key !== "Escape" || !this.#flight) return;
    event.preventDefault();
    event.stopPropagation();
    this.#putBack();
  }

  #putBack() {
    const [press, flight] = [this.#press, this.#flight];
    this.abandon();
    if (!press || !flight) return;
    press.list.comeHome();
    this.#hands.sayPutBack(press.card);
  }

  #measureAgain() {
    const [press, flight] = [this.#press, this.#flight];
    if (!press || !flight) return;
    press.list.fly(press.card.id, { x: 0, y: 0 });
    flight.groups = press.list.measure();
    flight.home = boxOf(press.card.element);
    this.#follow();
  }

  #end() {
    this.#life.abort();
    this.#press = null;
    this.#flight = null;
    delete document.documentElement.dataset.dragging;
  }
}

/** How far the hand has gone, the page's scrolling included. @param {Press} press @returns {Point} */
function shift({ from, at }) {
  const { x, y } = onPage(at);
  return { x: x - from.x, y: y - from.y };
}

/** @param {Point} point of the window @returns {Point} */
function onPage({ x, y }) {
  return { x: x + scrollX, y: y + scrollY };
}

/** What of the window is not covered by what stands at its foot. */
function sight() {
  const foot = document.querySelector(".rank-next")?.getBoundingClientRect().top ?? innerHeight;
  return { top: 0, bottom: Math.max(innerHeight / 2, Math.min(innerHeight, foot)) };
}
