/**
 * Every two learners in a table: rows and columns in order of place.
 * @import {Entry, PairedTest} from "#js/comparisons/types.js"
 */
import { marker } from "#js/charts/marker.js";
import { between, cellWords, isSure } from "#js/comparisons/paired-tests.js";

/** @param {Entry[]} learners by place */
export function testHeads(learners) {
  const corner = document.createElement("td");
  return [corner, ...learners.map((learner) => head(learner, "col"))];
}

/** @param {Entry[]} learners by place @param {PairedTest[]} tests */
export function testRows(learners, tests) {
  return learners.map((row) => {
    const made = document.createElement("tr");
    made.append(
      head(row, "row"),
      ...learners.map((column) => cell(row === column ? null : between(tests, row.who, column.who))),
    );
    return made;
  });
}

/** @param {Entry} learner @param {"row" | "col"} scope */
function head({ who, title }, scope) {
  const made = document.createElement("th");
  made.scope = scope;
  made.append(marker(who), title);
  return made;
}

/** @param {PairedTest | null} test */
function cell(test) {
  const made = document.createElement("td");
  if (!test) return made;
  const [difference = "", ...details] = cellWords(test);
  const shown = document.createElement(isSure(test) ? "strong" : "span");
  const small = document.createElement("small");
  Object.assign(made.dataset, { a: test.a, b: test.b });
  shown.textContent = difference;
  small.textContent = details.filter(Boolean).join(", ");
  made.append(shown, " ", small);
  return made;
}
