/**
 * Where a dragged card would land, from the pointer and the boxes of what stands in its list: numbers in, a place out.
 *
 * Up and down puts it between two groups, alone. To the side of a group, on its right half, ties it with that group: the
 * same picture as the result, in which ties stand side by side. A drag that never left its column's line, as most do,
 * ties nothing by accident: `wentAside` says whether it ever did.
 */

/** @typedef {import("#js/rankings/order.js").Place} Place */
/** @typedef {{left: number, top: number, right: number, bottom: number}} Box */
/** @typedef {{ids: readonly string[], box: Box}} GroupBox   from top to bottom, as they stand while nothing moves */
/** @typedef {{x: number, y: number}} Point */

/** A place among the others, and what shows it: this side of groups[at]. @typedef {Place & {at: number, side: "above" | "below" | "beside"}} Landing */

/** So far sideways means it, in CSS pixels. */
export const ASIDE = 24;
/** Further than this from its list a card comes home. */
const REACH = 160;
const BAR_OUTSIDE = 5;
/** So near an end of the window the page scrolls. */
const EDGE = 88;

/**
 * Null where it would land where it was, or nowhere.
 * @param {Point} point
 * @param {readonly GroupBox[]} groups
 * @param {{id: string, box: Box, wentAside: boolean}} card
 * @returns {Landing | null}
 */
export function landingOf(point, groups, { id, box, wentAside }) {
  if (isInside(point, box) || !isInReach(point, groups)) return null;
  const at = nearest(point.y, groups);
  const home = groups.findIndex(({ ids }) => ids.includes(id));
  const isAlone = groups[home]?.ids.length === 1;
  if (at === home && isAlone) return null;
  // Taken out, a card that stood alone leaves no group behind.
  const among = (/** @type {number} */ i) => (isAlone && i > home ? i - 1 : i);
  if (wentAside && isBeside(point, groups[at]))
    return at === home ? null : { group: among(at), joins: true, at, side: "beside" };
  const side = point.y < middle(groups[at].box) ? "above" : "below";
  const group = among(at) + (side === "below" ? 1 : 0);
  return isAlone && group === home ? null : { group, joins: false, at, side };
}

/** Its half on which it is tied. @param {Box} box @returns {Box} */
export function sideOf({ left, top, right, bottom }) {
  return { left: (left + right) / 2, top, right, bottom };
}

/** Where a bar shows that it will stand alone: in the middle between two groups. @param {readonly GroupBox[]} groups @param {Landing} landing */
export function barAt(groups, { at, side }) {
  const [above, below] = side === "above" ? [groups[at - 1], groups[at]] : [groups[at], groups[at + 1]];
  if (!above) return below.box.top - BAR_OUTSIDE;
  return below ? (above.box.bottom + below.box.top) / 2 : above.box.bottom + BAR_OUTSIDE;
}

/**
 * How fast the page scrolls by itself while a card is held near an end of what is in sight: −1 (up) … 1 (down). Only
 * where the hand has gone: a card that was taken up near an end stays in peace.
 * @param {number} y
 * @param {{from: number, top: number, bottom: number}} sight   `from`: where it was taken up
 */
export function pushOf(y, { from, top, bottom }) {
  const zone = Math.min(EDGE, (bottom - top) / 4);
  const [up, down] = [(top + zone - y) / zone, (y - bottom + zone) / zone];
  if (up > 0 && y < from) return -Math.min(1, up);
  return down > 0 && y > from ? Math.min(1, down) : 0;
}

/** @param {Point} point @param {GroupBox} group */
function isBeside({ x }, { box }) {
  return x >= sideOf(box).left;
}

/** @param {Point} point @param {Box} box */
function isInside({ x, y }, { left, top, right, bottom }) {
  return x >= left && x <= right && y >= top && y <= bottom;
}

/** @param {Point} point @param {readonly GroupBox[]} groups */
function isInReach({ x }, groups) {
  const left = Math.min(...groups.map(({ box }) => box.left));
  const right = Math.max(...groups.map(({ box }) => box.right));
  return x >= left - REACH && x <= right + REACH;
}

/** @param {number} y @param {readonly GroupBox[]} groups */
function nearest(y, groups) {
  const distances = groups.map(({ box }) => Math.max(box.top - y, y - box.bottom, 0));
  return distances.indexOf(Math.min(...distances));
}

/** @param {Box} box */
function middle({ top, bottom }) {
  return (top + bottom) / 2;
}
