/**
 * What a page that is being closed can still put away at once: in localStorage, which is small but does not keep one
 * waiting. For what IndexedDB was too slow (it may still be opening) or too full to take; the next page puts it there.
 */

/** @template {{id: string}} T */
export class LastStraw {
  #prefix;

  /** @param {string} kind */
  constructor(kind) {
    this.#prefix = `irlfr:last:${kind}:`;
  }

  /** @param {Iterable<T>} items */
  keep(items) {
    for (const item of items) attempt(() => localStorage.setItem(this.#prefix + item.id, JSON.stringify(item)));
  }

  /** What an earlier page left; what cannot be read stays where it is. @returns {T[]} */
  all() {
    const keys = attempt(() => Object.keys(localStorage).filter((key) => key.startsWith(this.#prefix))) ?? [];
    const items = keys.map((key) => attempt(() => JSON.parse(localStorage.getItem(key) ?? "null")));
    return items.filter((item) => typeof item?.id === "string");
  }

  /** @param {string} id */
  drop(id) {
    attempt(() => localStorage.removeItem(this.#prefix + id));
  }
}

/** A closed or full storage is none. @template T @param {() => T} act @returns {T | undefined} */
function attempt(act) {
  try {
    return act();
  } catch {
    return undefined;
  }
}
