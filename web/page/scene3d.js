// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The worlds in 3-D: one canvas behind all panes, one renderer, a part of the canvas for each pane.

import { Space } from "./paint/space.js";
import { isDark, onColours, readColours } from "./paint/palette.js";

const slowMs = 30; // a picture that takes longer, again and again, loses first pixels, then shadows

/** Throws where the browser has no WebGL; three.js would complain in the console, too. */
export const makePainter = (container) => {
  if (!document.createElement("canvas").getContext("webgl2")) throw new Error("no WebGL");
  const canvas = document.createElement("canvas");
  canvas.className = "space";
  canvas.setAttribute("aria-hidden", "true");
  const space = new Space(canvas);
  container.prepend(canvas);
  let [quality, cost] = [2, 0];
  let lost = false;
  const recolour = () => space.setColours({ ...readColours(), dark: isDark() });
  recolour();
  onColours(recolour);

  const adapt = (spent) => {
    cost = 0.9 * cost + 0.1 * spent;
    if (cost < slowMs || quality === 0) return;
    quality -= 1;
    cost = 0;
    if (quality === 0) space.setShadows(false);
  };
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    lost = true;
  });
  canvas.addEventListener("webglcontextrestored", () => { lost = false; });

  return {
    kind: "3-D",
    /** `views`: {pane, scene, picture} of each world. */
    paint(views, orbit) {
      if (lost) return;
      const begin = performance.now();
      const whole = container.getBoundingClientRect();
      const ratio = quality === 2 ? Math.min(2, devicePixelRatio) : 1;
      space.clear(whole.width, whole.height, ratio);
      for (const { pane, scene, picture } of views) {
        const { left, bottom, width, height } = pane.getBoundingClientRect();
        if (width < 2 || height < 2) continue;
        const part = { left: left - whole.left, bottom: whole.bottom - bottom, width, height };
        space.paint(part, scene, picture, orbit);
      }
      adapt(performance.now() - begin);
    },
  };
};
