/**
 * The rows of the comparison's table, in order of place.
 * @import {Entry} from "#js/comparisons/types.js"
 */
import { figure, percent, withError } from "#js/charts/figures.js";
import { marker } from "#js/charts/marker.js";

/** @param {Entry[]} entries */
export function resultRows(entries) {
  return entries.map((entry) => {
    const row = document.createElement("tr");
    row.dataset.who = entry.who;
    row.dataset.place = String(entry.place);
    const name = document.createElement("th");
    name.scope = "row";
    name.append(marker(entry.who), entry.title);
    row.append(
      cell(String(entry.place)),
      name,
      cell(withError(entry.mean_return, entry.standard_error)),
      cell(figure(entry.expected_return, 2)),
      cell(figure(entry.greedy_return, 2)),
      cell(percent(entry.share_of_optimum)),
      cell(String(entry.episodes)),
    );
    return row;
  });
}

/** @param {string} text */
function cell(text) {
  const made = document.createElement("td");
  made.textContent = text;
  return made;
}
