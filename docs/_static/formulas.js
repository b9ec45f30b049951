// SPDX-License-Identifier: GPL-2.0-only
// katex.js has been loaded before. A formula that it can not read stays as it was written.
for (const place of document.querySelectorAll(".math"))
  katex.render(place.textContent, place, { displayMode: place.tagName === "DIV", throwOnError: false });
