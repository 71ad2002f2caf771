/**
 * The rows of the comparison's table, in order of place. On a phone each row becomes a card, so every cell carries its
 * column's name; the roles keep it a table to assistive technology.
 * @import {Entry} from "#js/comparisons/types.js"
 */
import { figure, percent, withError } from "#js/charts/figures.js";
import { marker } from "#js/charts/marker.js";

/** @param {Entry[]} entries @param {(who: string) => boolean} isDiverged */
export function resultRows(entries, isDiverged) {
  return entries.map((entry) => {
    const row = document.createElement("tr");
    row.setAttribute("role", "row");
    row.dataset.who = entry.who;
    row.dataset.place = String(entry.place);
    row.append(
      cell("Place", "place", String(entry.place)),
      nameOf(entry, isDiverged(entry.who)),
      cell("Average", "mean", withError(entry.mean_return, entry.standard_error)),
      cell("Interval", "interval", intervalText(entry.interval_low, entry.interval_high)),
      cell("Expected", "expected", figure(entry.expected_return, 2)),
      cell("Of optimum", "share", percent(entry.share_of_optimum)),
      cell("Greedy", "greedy", figure(entry.greedy_return, 2)),
      cell("Success", "success", percent(entry.success_rate)),
      cell("Steps", "steps", figure(entry.mean_steps)),
      cell("Episodes", "episodes", String(entry.episodes)),
    );
    return row;
  });
}

/** "4.3 to 5.9"; a dash where one episode leaves it open. @param {number | null | undefined} low @param {number | null | undefined} high */
export function intervalText(low, high) {
  return low === null || low === undefined ? "–" : `${figure(low)} to ${figure(high)}`;
}

/** @param {Entry} entry @param {boolean} isDiverged */
function nameOf({ who, title }, isDiverged) {
  const name = document.createElement("th");
  name.scope = "row";
  name.setAttribute("role", "rowheader");
  name.append(marker(who), title);
  if (isDiverged) {
    const mark = document.createElement("small");
    mark.textContent = " diverged";
    name.append(mark);
  }
  return name;
}

/** @param {string} column @param {string} name @param {string} text */
function cell(column, name, text) {
  const made = document.createElement("td");
  made.setAttribute("role", "cell");
  made.dataset.column = column;
  made.dataset.figure = name;
  made.textContent = text;
  return made;
}
