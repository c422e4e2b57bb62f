// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// An oblique view: x to the right, y up, z toward the viewer and so down to the left.

import { extentOf } from "./picture.js";

const slant = 0.38;

/** Fits the scene into width x height pixels: the function from mm to pixels, and its scale. */
export const obliqueView = (scene, width, height) => {
  const { low, high } = extentOf(scene);
  const left = low[0] - slant * high[2] - 25;
  const right = high[0] - slant * low[2] + 25;
  const top = high[1] - slant * low[2] + 18;
  const bottom = low[1] - slant * high[2] - 8;
  const scale = Math.min(width / (right - left), height / (top - bottom));
  const x0 = width / 2 - ((left + right) / 2) * scale;
  const y0 = height / 2 + ((top + bottom) / 2) * scale;
  const project = ([x, y, z]) => [x0 + (x - slant * z) * scale, y0 - (y - slant * z) * scale];
  return { project, scale };
};

/** The direction from which the viewer looks, for what hides what. */
export const towardViewer = [slant, slant, 1];
