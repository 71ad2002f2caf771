/** How logs and confirmed orders reach the server. What it has is not sent again, and no call is longer than it takes. */

import { ApiError, api } from "#js/lib/api.js";

/** A server that says nothing for so long will not; the same parcel may be sent again. */
const ANSWER_WITHIN_MS = 60_000;
const MOST_EVENTS_AT_ONCE = 500;

/** @typedef {import("#js/lib/parcels.js").LogParcel} LogParcel */
/** @typedef {import("#js/lib/parcels.js").RankingParcel} RankingParcel */
/** @typedef {import("#js/lib/parcels.js").LoggedEvent} LoggedEvent */
/** @typedef {{worldId: string, sittingId: string}} SittingPlace */

export function rankingSender() {
  /** How many events of a sitting have been acknowledged. @type {Map<string, number>} */
  const acknowledged = new Map();

  /** @param {LogParcel | RankingParcel} parcel @returns {Promise<any>} */
  return async function send(parcel) {
    try {
      return await (parcel.kind === "log" ? sendLog(parcel) : sendRanking(parcel));
    } catch (error) {
      // It may have lost what it had: next time from the beginning.
      acknowledged.delete(parcel.sittingId);
      throw error;
    }
  };

  /** @param {LogParcel} parcel */
  async function sendLog({ worldId, sittingId, events }) {
    await sendEvents({ worldId, sittingId }, unknown(sittingId, events));
    return { id: sittingId, n_events: acknowledged.get(sittingId) };
  }

  /** The confirmation itself travels with the order, so that neither is ever there without the other. @param {RankingParcel} parcel */
  async function sendRanking({ worldId, sittingId, outcome, body }) {
    const events = unknown(sittingId, body.sitting.events.slice(0, -1));
    const nBefore = Math.max(0, events.length + 1 - MOST_EVENTS_AT_ONCE);
    await sendEvents({ worldId, sittingId }, events.slice(0, nBefore));
    const sitting = { id: body.sitting.id, events: [...events.slice(nBefore), ...body.sitting.events.slice(-1)] };
    const ranking = await api.put(`/worlds/${worldId}/rankings/${outcome}`, { ...body, sitting }, options());
    if (typeof ranking?.version !== "number") throw noAnswer();
    acknowledged.set(sittingId, Math.max(acknowledged.get(sittingId) ?? 0, ranking.n_events ?? 0));
    return ranking;
  }

  /** @param {SittingPlace} place @param {readonly LoggedEvent[]} events */
  async function sendEvents({ worldId, sittingId }, events) {
    for (let from = 0; from < events.length; from += MOST_EVENTS_AT_ONCE) {
      const body = { events: events.slice(from, from + MOST_EVENTS_AT_ONCE) };
      const answer = await api.post(`/worlds/${worldId}/sittings/${sittingId}/events`, body, options());
      if (answer?.id !== sittingId || typeof answer.n_events !== "number") throw noAnswer();
      acknowledged.set(sittingId, answer.n_events);
    }
  }

  /** @param {string} sittingId @param {readonly LoggedEvent[]} events */
  function unknown(sittingId, events) {
    const nKnown = acknowledged.get(sittingId) ?? 0;
    return events.filter(({ n }) => n >= nKnown);
  }
}

/** Of a call that is finished even if the page is closed. */
export function options() {
  return { keepalive: true, signal: AbortSignal.timeout(ANSWER_WITHIN_MS) };
}

/** A gateway that answers 200 with a page of its own has saved nothing. */
export function noAnswer() {
  const message = "Something on the way answered in the server's place.";
  return new ApiError({ status: 0, code: "offline", message });
}
