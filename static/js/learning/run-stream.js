/**
 * The events of a run as they come. The browser's EventSource reconnects by itself and says where it stopped
 * (`Last-Event-ID`); this closes it on the last event, or it would ask again for ever.
 * @import {Frame, Result} from "#js/learning/types.js"
 */

/**
 * @typedef {object} Listener
 * @property {(frame: Frame) => void} frame
 * @property {(result: Result & { learner: string }) => void} learner
 * @property {(status: "done" | "failed" | "cancelled", message: string) => void} end
 * @property {(isConnected: boolean) => void} connection
 * @property {() => void} lost the stream cannot be had any more
 */

/**
 * @param {string} runId
 * @param {Listener} listener
 * @param {AbortSignal} signal
 */
export function followRun(runId, listener, signal) {
  const source = new EventSource(`/api/v1/runs/${runId}/events`);
  const end = (/** @type {MessageEvent} */ event) => {
    source.close();
    const { status, message = "" } = JSON.parse(event.data);
    listener.end(status, message);
  };
  source.addEventListener("open", () => listener.connection(true), { signal });
  source.addEventListener("frame", (event) => listener.frame(JSON.parse(event.data)), { signal });
  source.addEventListener("learner", (event) => listener.learner(JSON.parse(event.data)), { signal });
  source.addEventListener("done", end, { signal });
  source.addEventListener("failed", end, { signal });
  source.addEventListener(
    "error",
    () => {
      if (source.readyState === EventSource.CLOSED) listener.lost();
      else listener.connection(false);
    },
    { signal },
  );
  signal.addEventListener("abort", () => source.close());
}
