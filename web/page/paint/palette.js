// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The colours of the page's style sheet, for painters, which cannot read var(--...).

const names = [
  "ink",
  "muted",
  "line",
  "ground",
  "card",
  "sky",
  "accent",
  "cube",
  "static-cube",
  "base",
  "calibrated",
  "left",
  "right",
  "met",
  "missed",
  "good",
  "usable",
  "unusable",
  "sep",
  "other",
  "dead-reckoning",
];

/** The colours as they are now, by name: they change with the light of the page. */
export const readColours = () => {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(
    names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]),
  );
};

const sides = ["left", "right", "sep", "other", "dead-reckoning", "met", "static-cube", "accent"];

/** The name of the colour of the peer that stands at this place, counted from 0. */
export const colourOfPeer = (place) => sides[place % sides.length];

const algorithms = ["base", "sep", "dead-reckoning"];

/** The name of the colour of an algorithm. */
export const colourOfAlgorithm = (name) => (algorithms.includes(name) ? name : "other");

const darkness = matchMedia("(prefers-color-scheme: dark)");

/** Calls back when the colours may have changed. */
export const onColours = (callback) => darkness.addEventListener("change", callback);
export const isDark = () => darkness.matches;
