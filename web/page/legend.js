// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The legend of a chart: a button for each curve, which hides and shows it, with its value.

import { make } from "./dom.js";

/** A button that hides and shows what has that label; before it stands the mark of its data. */
export const toggleOf = ({ label, colour, dash, mark = "line" }, isShown, onToggle, ...more) => {
  const swatch = make("span",
    { class: `swatch ${mark}${dash ? " dash" : ""}`, "aria-hidden": "true" });
  swatch.style.color = colour;
  return make("button", {
    type: "button",
    "aria-pressed": isShown,
    title: "show or hide",
    onclick: ({ currentTarget }) =>
      currentTarget.setAttribute("aria-pressed", String(onToggle())),
  }, swatch, label, ...more);
};

/**
 * {buttons, values}: of the curves {name, label, colour, dash}, whose colours are of the palette.
 * `hidden` is the set of the names that are not shown; `changed` is called after each change.
 */
export const legendOf = (curves, hidden, changed = () => {}) => {
  const values = curves.map(() => make("span", { class: "figure" }));
  const buttons = curves.map((curve, i) => {
    const toggle = () => {
      if (!hidden.delete(curve.name)) hidden.add(curve.name);
      changed();
      return !hidden.has(curve.name);
    };
    const shown = { ...curve, colour: `var(--${curve.colour})` };
    return toggleOf(shown, !hidden.has(curve.name), toggle, " ", values[i]);
  });
  return { buttons, values };
};
