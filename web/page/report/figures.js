// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Finds the figures of a report and puts in their places those that answer. Figures of one
// .zoom-group, which show the same time, zoom and point together.

import { make } from "../dom.js";
import { Bars } from "./bars.js";
import { spansOf } from "./curves.js";
import { Plot } from "./plot.js";
import { Zoom } from "./zoom.js";

const buttonsOf = (zoom) => [
  ["+", "zoom in", () => zoom.scale(0.5)],
  ["−", "zoom out", () => zoom.scale(2)],
  ["←", "earlier", () => zoom.move(-0.25)],
  ["→", "later", () => zoom.move(0.25)],
  ["all", "show all", () => zoom.reset()],
].map(([words, label, onclick]) =>
  make("button", { type: "button", "aria-label": label, onclick }, words));

/** One zoom for all figures of the group, over all that they span. */
const zoomOfGroup = (group, places, all) => {
  const spans = places.map((place) => spansOf(all[place.dataset.figure]).x);
  const zoom = new Zoom([
    Math.min(...spans.map(([low]) => low)), Math.max(...spans.map(([, high]) => high)),
  ]);
  group.querySelector(".zoom-buttons").replaceChildren(...buttonsOf(zoom));
  group.querySelector(".zoom-help").hidden = false;
  return zoom;
};

/** The figures by name. `all` is the data, by name, too. */
export const setUpFigures = (all, makeChart) => {
  const isPlot = (place) => all[place.dataset.figure]?.kind === "plot";
  const zooms = new Map();
  [...document.querySelectorAll(".zoom-group")].forEach((group, i) => {
    const places = [...group.querySelectorAll("figure[data-figure]")].filter(isPlot);
    if (places.length === 0) return;
    const shared = { zoom: zoomOfGroup(group, places, all), group: `zoom-${i}` };
    places.forEach((place) => zooms.set(place, shared));
  });
  const figures = {};
  for (const place of document.querySelectorAll("figure[data-figure]")) {
    const name = place.dataset.figure;
    const data = all[name];
    if (!data || !place.querySelector("svg")) continue;
    if (isPlot(place)) {
      const alone = { zoom: new Zoom(spansOf(data).x, data.log_x), group: name };
      const options = { makeChart, ...(zooms.get(place) ?? alone) };
      figures[name] = new Plot(place, data, options);
    } else figures[name] = new Bars(place, data);
  }
  return figures;
};
