/**
 * The browser's side of tests/app/test_sitting_agreement.py: reads a sitting a line (JSON: its events, the first of which
 * is `begin`) and answers with a line that tells what the page makes of each: the state, or null where it refuses.
 */

import { createInterface } from "node:readline";
import { apply, beginState } from "#js/rankings/sitting-state.js";

/** @param {any[]} events */
function states([begin, ...events]) {
  let state = beginState(begin);
  const rest = events.map((event) => {
    const next = apply(state, event);
    state = next ?? state;
    return next;
  });
  return [beginState(begin), ...rest];
}

for await (const line of createInterface({ input: process.stdin })) {
  process.stdout.write(`${JSON.stringify(states(JSON.parse(line)))}\n`);
}
