/** From a picture's text to a file: rasterised where PNG is asked for, handed to the browser to keep. */

/** The largest side of a picture of points; browsers give up silently somewhat beyond. */
const LARGEST_SIDE = 8192;

/**
 * @param {string} svg @param {number} [scale] points for one unit of the picture
 * @returns {Promise<Blob>}
 */
export async function toPng(svg, scale = 3) {
  const image = await imageOf(svg);
  const fits = Math.min(scale, LARGEST_SIDE / Math.max(image.width, image.height));
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(image.width * fits);
  canvas.height = Math.round(image.height * fits);
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  const blob = await new Promise((/** @type {(made: Blob | null) => void} */ resolve) => canvas.toBlob(resolve));
  if (!blob) throw new Error("The browser made no picture of points.");
  return blob;
}

/** @param {string} svg @returns {Promise<HTMLImageElement>} */
export async function imageOf(svg) {
  const address = URL.createObjectURL(svgBlob(svg));
  try {
    const image = new Image();
    image.src = address;
    await image.decode();
    return image;
  } finally {
    URL.revokeObjectURL(address);
  }
}

/** @param {string} svg */
export function svgBlob(svg) {
  return new Blob([svg], { type: "image/svg+xml" });
}

/** @param {Blob} blob @param {string} name */
export function saveFile(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  // The browser reads it after this task; a minute is more than it needs.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

/** A name that every system takes: letters, digits, hyphens. @param {string} words */
export function fileNameOf(words) {
  const plain = words
    .normalize("NFKD")
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, "-");
  return plain.replace(/^-+|-+$/g, "").slice(0, 60) || "picture";
}
