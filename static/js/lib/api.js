/** The JSON API: paths start below /api/v1 (`api.get("/worlds/…")`); every refusal becomes an `ApiError`. */

const ROOT = "/api/v1";

/** A refusal of the server, or of the network (`status` 0, `code` "offline"). */
export class ApiError extends Error {
  /**
   * @param {{status: number, code: string, message: string, fields?: Record<string, unknown>}} refusal
   */
  constructor({ status, code, message, fields = {} }) {
    super(message);
    this.name = "ApiError";
    this.status = status;
    this.code = code;
    this.fields = fields;
  }

  /** True when the same request may well succeed later: no network, too busy, a fault of the server. */
  get isTemporary() {
    return this.status === 0 || this.status === 408 || this.status === 429 || this.status >= 500;
  }
}

/** @typedef {{signal?: AbortSignal, keepalive?: boolean}} CallOptions */

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
  });
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
