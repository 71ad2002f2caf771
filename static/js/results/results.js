/**
 * The page of results: the server writes every figure, this draws the charts and the boards. An entry script.
 * @import {ResultsPageData, Standing} from "#js/results/types.js"
 */
import "#js/elements/irl-board.js";
import { markerPath, walker } from "#js/board/colours.js";
import { byId } from "#js/lib/dom.js";
import { pageData } from "#js/lib/page-data.js";
import { saveMenu } from "#js/pictures/save-menu.js";
import { drawPlaces, drawShares } from "#js/results/charts.js";

const NARROWEST = 280;
/** On a projector everything is so many times as large; results.css has the same width. */
const LARGER = 1.3;
const WIDE = window.matchMedia("(min-width: 96rem)");

/** @type {ResultsPageData} */
const { results, worlds } = pageData();
drawMarkers();
drawBoards();
if (results.standings.length > 0) {
  mount("places-chart", drawPlaces, "places-title", "places-caption");
  mount("shares-chart", drawShares, "shares-title", "shares-caption");
}

function drawMarkers() {
  for (const path of document.querySelectorAll("svg.marker[data-who] > path")) {
    const who = path.parentElement?.getAttribute("data-who") ?? "";
    path.setAttribute("d", markerPath(walker(who).shape));
  }
}

function drawBoards() {
  for (const element of document.querySelectorAll("irl-board[data-world]")) {
    const board = /** @type {import("#js/elements/irl-board.js").IrlBoard} */ (element);
    board.world = worlds[board.dataset.world ?? ""] ?? null;
  }
}

/**
 * Draw a chart as wide as its box is, and again whenever that changes.
 * @param {string} id @param {(standings: Standing[], width: number) => SVGElement | Element} draw @param {string} titleId @param {string} captionId
 */
function mount(id, draw, titleId, captionId) {
  const box = byId(id);
  let drawn = "";
  const paint = () => {
    const scale = WIDE.matches ? LARGER : 1;
    const width = Math.max(NARROWEST, Math.floor(box.clientWidth / scale));
    if (drawn === `${width} ${scale}`) return;
    drawn = `${width} ${scale}`;
    const chart = draw(results.standings, width);
    chart.setAttribute("width", String(width * scale));
    chart.setAttribute("height", String(Number(chart.getAttribute("height")) * scale));
    box.replaceChildren(chart);
  };
  paint();
  new ResizeObserver(paint).observe(box);
  const title = byId(titleId);
  const about = { title: title.textContent ?? "", note: byId(captionId).textContent ?? "" };
  title.after(saveMenu(() => box.querySelector("svg"), about));
}
