/**
 * What a person takes away from a comparison: its figure and its film, a link for others, the file and the command that
 * compute it again, what to cite.
 * @import {Parts} from "#js/elements/compare-page.js"
 * @import {ComparePageData} from "#js/comparisons/types.js"
 * @import {SaveMenu, Source} from "#js/pictures/save-menu.js"
 * @typedef {{key: string, short: string, text: string, bibtex: string, learners: string[]}} Citation
 */
import { fileName, reproduceCommand } from "#js/comparisons/reproduce.js";
import { ShareLink } from "#js/comparisons/share-link.js";
import { announce } from "#js/lib/announce.js";
import { copyText } from "#js/lib/clipboard.js";
import { runApi } from "#js/lib/run-address.js";
import { comparisonData } from "#js/pictures/comparison-data.js";
import { saveFile } from "#js/pictures/files.js";
import "#js/pictures/save-menu.js";

/** The software says its version in the caption; it needs no place among the methods. */
const SOFTWARE = "irlfr-software";

export class TakeAway {
  #root;
  #data;
  #unknownTo;
  #link;

  /** @param {Parts} parts */
  constructor({ root, data, unknownTo }) {
    this.#root = root;
    this.#data = /** @type {ComparePageData & { citations: Citation[] }} */ (data);
    this.#unknownTo = unknownTo;
    const part = (/** @type {string} */ name) => this.#part(name);
    this.#link = new ShareLink(data.run.id, { part, tell: (sentence) => this.#tell("link", sentence) });
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    const { run } = this.#data;
    this.#part("command").textContent = reproduceCommand(run);
    this.#part("download").href = `/api/v1${runApi(run.id, "/demonstrations.jsonl")}`;
    this.#part("download").download = fileName(run);
    const menu = /** @type {SaveMenu} */ (document.createElement("save-menu"));
    menu.source = () => this.#picture();
    this.#part("picture").replaceChildren(menu);
    if (this.#isOwn) this.#link.start(signal);
    this.#root.addEventListener("click", (event) => this.#onClick(event), { signal });
  }

  /** The figure as it stands: with the episode that is on stage. @returns {Source} */
  #picture() {
    const episode = Number(this.#root.dataset.episode) - 1;
    const citations = this.#data.citations.filter(({ key }) => key !== SOFTWARE).map(({ short }) => short);
    const drawn = comparisonData(this.#data, { unknownTo: this.#unknownTo, episode, citations });
    return {
      name: `irlfr-${this.#data.run.id.slice(0, 8)}-comparison`,
      title: "the comparison",
      svg: async () => (await import("#js/pictures/comparison.js")).comparisonSvg(drawn),
      film: import("#js/pictures/film.js").then(({ walksFilm }) => walksFilm(drawn)),
    };
  }

  /** @param {Event} event */
  #onClick(event) {
    const action =
      event.target instanceof Element ? event.target.closest("[data-action]")?.getAttribute("data-action") : null;
    if (action === "make-link") this.#link.makeAndCopy();
    if (action === "copy-link" && this.#isOwn) this.#link.copy();
    if (action === "copy-link" && !this.#isOwn) this.#copy(location.href, "link", "The link is copied.");
    if (action === "take-link-back") this.#link.takeBack();
    if (action === "copy-command") this.#copy(reproduceCommand(this.#data.run), "command", "The command is copied.");
    if (action === "copy-bibtex") this.#copy(this.#bibtex, "cite", "The citations are copied as BibTeX.");
    if (action === "save-bibtex") saveFile(new Blob([this.#bibtex], { type: "application/x-bibtex" }), "irlfr.bib");
  }

  get #isOwn() {
    return this.#data.is_own !== false;
  }

  get #bibtex() {
    return `${this.#data.citations.map(({ bibtex }) => bibtex).join("\n\n")}\n`;
  }

  /** @param {string} text @param {"link" | "command" | "cite"} where @param {string} sentence */
  async #copy(text, where, sentence) {
    const isCopied = await copyText(text);
    this.#tell(where, isCopied ? sentence : `Your browser does not let this page copy. Here it is: ${text}`);
  }

  /** @param {"link" | "command" | "cite"} where @param {string} sentence */
  #tell(where, sentence) {
    this.#part(`${where}-told`).textContent = sentence;
    announce(sentence);
  }

  /** @param {string} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-part="${name}"], [data-action="${name}"]`);
  }
}
