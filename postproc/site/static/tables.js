// SPDX-License-Identifier: GPL-2.0-or-later
// Tables of many columns: each cell knows the name of its column, which tables.css shows on phones.
"use strict";

document.addEventListener("DOMContentLoaded", () => {
  const FEWEST = 4; // columns
  for (const table of document.querySelectorAll("article table")) {
    const head = [...table.querySelectorAll("thead th")].map((cell) => cell.textContent.trim());
    if (head.length < FEWEST) continue;
    table.classList.add("many-columns");
    for (const row of table.querySelectorAll("tbody tr"))
      [...row.cells].forEach((cell, k) => { cell.dataset.label = head[k]; });
  }
});
