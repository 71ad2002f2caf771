/** SVG as text: a picture that leaves the page is written, not built of elements, so that a worker or a test can make it too. */

/** Every reader has one of these; their letters are equally wide, so that a line breaks alike everywhere. */
export const FONT = "Helvetica, Arial, 'Liberation Sans', sans-serif";

/** @typedef {Record<string, string | number | undefined>} Attributes */
/** @typedef {{markup: string, width: number, height: number}} Figure   a part of a picture, its corner at (0, 0) */

/** One element; attributes that are undefined are left out. @param {string} name @param {Attributes} [attributes] @param {string[]} children markup */
export function tag(name, attributes = {}, ...children) {
  const written = Object.entries(attributes)
    .filter(([, value]) => value !== undefined)
    .map(([key, value]) => ` ${key}="${typeof value === "number" ? short(value) : escaped(String(value))}"`);
  const content = children.join("");
  return `<${name}${written.join("")}${content === "" ? "/>" : `>${content}</${name}>`}`;
}

/**
 * A line of words; (x, y) is where its base line begins, ends or has its middle.
 * @param {string} words @param {number} x @param {number} y
 * @param {{size?: number, weight?: number, fill?: string, anchor?: "start" | "middle" | "end"}} [look]
 */
export function text(words, x, y, { size = 12, weight, fill, anchor } = {}) {
  const attributes = { x, y, "font-size": size, "font-weight": weight, fill, "text-anchor": anchor };
  return tag("text", attributes, escaped(words));
}

/** Put a part somewhere. @param {Figure | string} part @param {number} x @param {number} y @param {number} [scale] */
export function place(part, x, y, scale = 1) {
  const markup = typeof part === "string" ? part : part.markup;
  const resized = scale === 1 ? "" : ` scale(${short(scale)})`;
  return tag("g", { transform: `translate(${short(x)} ${short(y)})${resized}` }, markup);
}

/**
 * A whole picture. `width` and `height` say how large it is meant to be (a number: pixels), the parts count in `box`.
 * @param {Figure} figure
 * @param {{title: string, description?: string, ground?: string | null, unit?: "px" | "mm", scale?: number}} about
 *   `ground`: the colour behind it; `scale`: units of measure for one of the figure's
 */
export function svgDocument({ markup, width, height }, { title, description, ground = null, unit = "px", scale = 1 }) {
  const attributes = {
    xmlns: "http://www.w3.org/2000/svg",
    width: measure(width * scale, unit),
    height: measure(height * scale, unit),
    viewBox: `0 0 ${short(width)} ${short(height)}`,
    role: "img",
    "font-family": FONT,
  };
  return tag(
    "svg",
    attributes,
    tag("title", {}, escaped(title)),
    description ? tag("desc", {}, escaped(description)) : "",
    ground ? tag("rect", { width, height, fill: ground }) : "",
    markup,
  );
}

/** @param {string} words */
export function escaped(words) {
  return words.replace(/[&<>"]/g, (character) => `&#${character.charCodeAt(0)};`);
}

/** A hundredth of a unit is finer than any printer. @param {number} value */
export function short(value) {
  return String(Math.round(value * 100) / 100);
}

/** @param {number} value @param {string} unit */
function measure(value, unit) {
  return unit === "px" ? short(value) : `${short(value)}${unit}`;
}
