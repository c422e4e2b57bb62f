// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The frame of one world: whose it is, the view that a painter fills, and figures below it.

import { make } from "./dom.js";
import { colourOfPeer } from "./paint/palette.js";

/**
 * {root, view, figures} for the side at that place, counted from 0. `notes` stand beside its name;
 * `figures` holds an element for each of `labels`, the first of them bold.
 */
export const makePane = ({ id, place, letter, who }, notes, labels, orbit) => {
  const view = make("div", {
    class: "view", tabindex: 0, role: "group", "aria-roledescription": "3-D view",
    "aria-label": `World of ${letter}. Arrow keys turn the view, plus and minus scale it, `
      + "0 puts it back.",
  });
  orbit.listen(view);
  const figures = labels.map((_, i) => make(i === 0 ? "b" : "span", { class: "figure" }));
  const root = make("figure", { class: `pane side-${colourOfPeer(place)}`, "data-peer": id },
    make("figcaption", {},
      make("span", { class: "letter", "aria-hidden": "true" }, letter),
      make("span", { class: "who" }, who),
      ...notes),
    view,
    make("p", { class: "readout" },
      ...labels.map((label, i) => make("span", {}, `${label} `, figures[i]))));
  return { root, view, figures };
};
