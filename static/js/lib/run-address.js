/**
 * Where a run lives. A page that was opened by a shared link hands the link's key on, to its own calls and to the pages it
 * leads to.
 */

/** The page of a run, or of something about it. @param {string} id @param {string} [rest] "" or "/comparison" */
export function runAddress(id, rest = "") {
  return withKey(`/runs/${id}${rest}`);
}

/** The same in the API, as `lib/api.js` takes it. @param {string} id @param {string} [rest] */
export function runApi(id, rest = "") {
  return withKey(`/runs/${id}${rest}`);
}

/** The key of the link that this page was opened by. @returns {string | null} */
export function sharedKey() {
  return new URLSearchParams(location.search).get("key");
}

/** @param {string} path */
function withKey(path) {
  const key = sharedKey();
  if (key === null) return path;
  return `${path}${path.includes("?") ? "&" : "?"}key=${encodeURIComponent(key)}`;
}
