/**
 * `<save-menu>`: a small button "Save ▾" that a page puts beside a board or a chart.
 *
 *   import { saveMenu } from "#js/pictures/save-menu.js";
 *
 * A board, in one line (what it shows at the moment of saving, with title, legend and the world's seed):
 *
 *   panel.append(saveMenu(board, { title: "What IRLFR learned" }));            // an <irl-board>
 *
 * A chart that is an <svg> of the page (its colours are copied, those of the light theme), in one line as well:
 *
 *   section.append(saveMenu(() => box.querySelector("svg"), { title: "Average return" }));
 *
 * Anything else says itself what it looks like:
 *
 *   const menu = document.createElement("save-menu");
 *   menu.source = () => ({ name: "irlfr-convergence", title: "Convergence", svg: () => lineChartSvg(…) });
 *
 * Options: `name` the file's name without ending (made of the title unless given), `note` a sentence below the board, `values` what
 * the numbers of its view are ("reward lost from there on") where they are not a learned reward, `film` (see `film.js`) where the thing moves. The title may be a function: it is asked when somebody saves. Styles: components/controls.css.
 * What draws is loaded when somebody saves, so that a page with a menu opens as fast as one without.
 */
import { announce } from "#js/lib/announce.js";
import { fileNameOf, saveFile, svgBlob, toPng } from "#js/pictures/files.js";

/** @typedef {import("#js/elements/irl-board.js").IrlBoard} IrlBoard */

/**
 * @typedef {object} Source
 * @property {string} name      of the file, without its ending
 * @property {string} title     what it is, for people
 * @property {() => string | Promise<string>} svg
 * @property {Film | Promise<Film>} [film]
 *
 * @typedef {object} Film       something that moves
 * @property {("gif" | "webm")[]} kinds
 * @property {(kind: "gif" | "webm", watch: {signal: AbortSignal, onProgress: (share: number) => void}) => Promise<Blob>} make
 *
 * @typedef {{title: string | (() => string), name?: string, note?: string | (() => string), values?: string | (() => string), film?: () => Film | Promise<Film>}} About
 */

/** CSS pixels, as controls.css has it, with a little air. */
const SHEET_WIDTH = 240;

const KINDS = /** @type {const} */ ({
  png: { title: "PNG", hint: "image" },
  svg: { title: "SVG", hint: "vectors, for print" },
  gif: { title: "GIF", hint: "moving picture" },
  webm: { title: "WebM", hint: "film, finer" },
});

/** @param {IrlBoard | (() => Element | null)} thing @param {About} about */
export function saveMenu(thing, about) {
  const menu = /** @type {SaveMenu} */ (document.createElement("save-menu"));
  menu.source = () => sourceOf(thing, about);
  return menu;
}

export class SaveMenu extends HTMLElement {
  #life = new AbortController();
  /** @type {AbortController | null} */
  #filming = null;
  /** @type {() => Source} */
  source = () => {
    throw new Error("This <save-menu> has no source.");
  };

  connectedCallback() {
    this.#life = new AbortController();
    const { signal } = this.#life;
    if (!this.querySelector("details")) this.#build();
    this.addEventListener("click", (event) => this.#onClick(event), { signal });
    this.addEventListener("keydown", (event) => this.#onKey(event), { signal });
    this.#details.addEventListener("toggle", () => this.#fill(), { signal });
    document.addEventListener("click", (event) => this.#onClickElsewhere(event), { signal });
  }

  disconnectedCallback() {
    this.#life.abort();
    this.#filming?.abort();
  }

  /** Make the file and hand it to the browser. @param {keyof typeof KINDS} kind */
  async save(kind) {
    const { name, svg, film } = this.source();
    const file = `${name}.${kind}`;
    try {
      const blob = await this.#make(kind, { svg, film });
      if (!blob) return;
      saveFile(blob, file);
      this.#say(`Saved as ${file}.`);
    } catch (error) {
      this.#say(`Your browser could not make this ${KINDS[kind].title}. SVG always works.`);
      reportError(error);
    }
  }

  /** @param {keyof typeof KINDS} kind @param {Pick<Source, "svg" | "film">} source @returns {Promise<Blob | null>} null: cancelled */
  async #make(kind, { svg, film }) {
    if (kind === "svg") return svgBlob(await svg());
    if (kind === "png") return toPng(await svg());
    return this.#film(kind, film);
  }

  #build() {
    this.innerHTML = `<details class="menu save-menu"><summary class="button button--quiet"><span>Save</span> <span aria-hidden="true">▾</span></summary>
      <div class="menu-sheet save-sheet"><div class="save-kinds" data-part="kinds"></div>
      <div class="save-film" data-part="film" hidden><progress max="1" aria-label="The film is being made"></progress><button class="button" type="button" data-cancel>Cancel</button></div>
      <p class="save-words" data-part="words" role="status"></p></div></details>`;
  }

  get #details() {
    return /** @type {HTMLDetailsElement} */ (this.querySelector("details"));
  }

  /** What can be saved may have changed since the menu was last open. */
  async #fill() {
    if (!this.#details.open) return;
    const { title, film } = this.source();
    const button = (/** @type {keyof typeof KINDS} */ kind) => kindButton(kind, title);
    this.#part("words").textContent = "";
    this.#part("kinds").replaceChildren(button("png"), button("svg"), ...(film ? [button("gif")] : []));
    const { left } = this.getBoundingClientRect();
    const room = document.documentElement.clientWidth - left;
    this.#details.dataset.opens = room < SHEET_WIDTH ? "left" : "right";
    if ((await film)?.kinds.includes("webm")) this.#part("kinds").append(button("webm"));
  }

  /** @param {"gif" | "webm"} kind @param {Source["film"]} film @returns {Promise<Blob | null>} null: cancelled */
  async #film(kind, film) {
    if (!film) return null;
    const filming = new AbortController();
    this.#filming = filming;
    this.#showFilming(true);
    const bar = /** @type {HTMLProgressElement} */ (this.querySelector("progress"));
    bar.value = 0;
    this.#say("Drawing the film …");
    try {
      return await (await film).make(kind, { signal: filming.signal, onProgress: (share) => (bar.value = share) });
    } catch (error) {
      if (filming.signal.aborted) return null;
      throw error;
    } finally {
      this.#filming = null;
      this.#showFilming(false);
    }
  }

  /** @param {boolean} isFilming */
  #showFilming(isFilming) {
    this.#part("film").hidden = !isFilming;
    for (const button of this.#part("kinds").querySelectorAll("button")) button.disabled = isFilming;
    if (isFilming) this.#part("film").querySelector("button")?.focus();
    else this.querySelector("summary")?.focus();
  }

  /** @param {string} sentence */
  #say(sentence) {
    this.#part("words").textContent = sentence;
    if (!this.#details.open) announce(sentence);
  }

  /** @param {MouseEvent} event */
  #onClick(event) {
    const button = event.target instanceof Element ? event.target.closest("button") : null;
    if (button?.dataset.kind) this.save(/** @type {keyof typeof KINDS} */ (button.dataset.kind));
    if (button?.dataset.cancel !== undefined) {
      this.#filming?.abort();
      this.#say("The film was not made.");
    }
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    if (event.key !== "Escape" || !this.#details.open) return;
    event.stopPropagation();
    this.#details.open = false;
    this.querySelector("summary")?.focus();
  }

  /** @param {MouseEvent} event */
  #onClickElsewhere(event) {
    if (this.#details.open && event.target instanceof Node && !this.contains(event.target)) this.#details.open = false;
  }

  /** @param {string} name */
  #part(name) {
    return /** @type {HTMLElement} */ (this.querySelector(`[data-part="${name}"]`));
  }
}

/** @param {keyof typeof KINDS} kind @param {string} title of the picture */
function kindButton(kind, title) {
  const button = document.createElement("button");
  button.type = "button";
  button.className = "button";
  button.dataset.kind = kind;
  const hint = document.createElement("small");
  hint.textContent = KINDS[kind].hint;
  button.append(KINDS[kind].title, hint);
  button.setAttribute("aria-label", `Save ${title} as ${KINDS[kind].title}, ${KINDS[kind].hint}`);
  return button;
}

/** @param {IrlBoard | (() => Element | null)} thing @param {About} about @returns {Source} */
function sourceOf(thing, { title: naming, note: noting = "", values: meaning = "", name, film }) {
  const title = said(naming);
  const note = said(noting);
  const svg = async () => {
    if (thing instanceof HTMLElement) return boardNow(thing, { title, note, values: said(meaning) });
    const { chartPicture } = await import("#js/pictures/page-chart.js");
    return chartPicture(thing(), { title, note });
  };
  return { name: name ?? `irlfr-${fileNameOf(title)}`, title, svg, ...(film ? { film: film() } : {}) };
}

/** @param {string | (() => string)} words */
function said(words) {
  return typeof words === "function" ? words() : words;
}

/** @param {IrlBoard} board @param {{title: string, note: string, values: string}} about */
async function boardNow(board, about) {
  if (!board.world) throw new Error("This board shows no world yet.");
  const { boardPicture } = await import("#js/pictures/picture.js");
  return boardPicture(board.world, board.view, about);
}

customElements.define("save-menu", SaveMenu);
