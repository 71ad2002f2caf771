/**
 * What the server put on the page: the JSON in `<script type="application/json" id="page-data">`.
 * @template T
 * @returns {T}
 */
export function pageData() {
  const island = document.getElementById("page-data");
  if (!island) throw new Error('This page has no <script id="page-data">, so there is nothing to show.');
  return JSON.parse(island.textContent ?? "null");
}
