/** The JSON API: paths start below /api/v1 (`api.get("/worlds/…")`); every refusal becomes an `ApiError`. */

const ROOT = "/api/v1";
/** A server that asks for more has made a mistake, or one of our clocks has. */
const LONGEST_RETRY_AFTER_MS = 600_000;
/** Browsers refuse to keep larger requests alive (64 KiB for all of a page's together). */
const LARGEST_KEPT_ALIVE = 60_000;

/** A refusal of the server, or of the network (`status` 0, `code` "offline"). */
export class ApiError extends Error {
  /**
   * @param {{status: number, code: string, message: string, fields?: Record<string, unknown>, retryAfterMs?: number | null}} refusal
   */
  constructor({ status, code, message, fields = {}, retryAfterMs = null }) {
    super(message);
    this.name = "ApiError";
    this.status = status;
    this.code = code;
    this.fields = fields;
    /** How long the server asked to be left alone; null if it did not. */
    this.retryAfterMs = retryAfterMs;
  }

  /** True when the same request may well succeed later: no network, too busy, a fault of the server. */
  get isTemporary() {
    return this.status === 0 || this.status === 408 || this.status === 429 || this.status >= 500;
  }
}

/** @typedef {{signal?: AbortSignal, keepalive?: boolean}} CallOptions   `keepalive`: finish it even if the page is closed, where the browser can */

export const api = {
  /** @param {string} path @param {CallOptions} [options] @returns {Promise<any>} */
  get: (path, options) => call("GET", path, undefined, options),
  /** @param {string} path @param {unknown} [body] @param {CallOptions} [options] @returns {Promise<any>} */
  post: (path, body, options) => call("POST", path, body, options),
  /** @param {string} path @param {unknown} [body] @param {CallOptions} [options] @returns {Promise<any>} */
  put: (path, body, options) => call("PUT", path, body, options),
  /** @param {string} path @param {CallOptions} [options] @returns {Promise<any>} */
  delete: (path, options) => call("DELETE", path, undefined, options),
};

/**
 * @param {string} method
 * @param {string} path
 * @param {unknown} body
 * @param {CallOptions} [options]
 */
async function call(method, path, body, options = {}) {
  const response = await send(method, path, body, options);
  const answer = await readJson(response);
  if (response.ok) return answer;
  const error = answer?.error ?? {};
  throw new ApiError({
    status: response.status,
    code: error.code ?? `http_${response.status}`,
    message: error.message ?? `The server answered ${response.status} ${response.statusText}.`,
    fields: error.fields ?? {},
    retryAfterMs: retryAfterMs(response.headers.get("Retry-After")),
  });
}

/** Seconds, or a date. @param {string | null} text @param {number} [now] ms since 1970 */
export function retryAfterMs(text, now = Date.now()) {
  if (text === null || text.trim() === "") return null;
  const ms = /^\s*\d+\s*$/.test(text) ? 1000 * Number(text) : Date.parse(text) - now;
  return Number.isFinite(ms) ? Math.min(LONGEST_RETRY_AFTER_MS, Math.max(0, ms)) : null;
}

/**
 * @param {string} method
 * @param {string} path
 * @param {unknown} body
 * @param {CallOptions} options
 */
async function send(method, path, body, options) {
  /** @type {RequestInit} */
  const request = { method, headers: { Accept: "application/json" }, credentials: "same-origin", ...options };
  if (body !== undefined) {
    request.body = JSON.stringify(body);
    request.keepalive = options.keepalive === true && request.body.length < LARGEST_KEPT_ALIVE;
    request.headers = { ...request.headers, "Content-Type": "application/json" };
  }
  try {
    return await fetch(ROOT + path, request);
  } catch (cause) {
    if (cause instanceof DOMException && cause.name === "AbortError") throw cause;
    throw new ApiError({ status: 0, code: "offline", message: "The server cannot be reached just now." });
  }
}

/** @param {Response} response */
async function readJson(response) {
  const text = await response.text();
  if (!text) return null;
  try {
    return JSON.parse(text);
  } catch {
    return null;
  }
}
