// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The worlds in 3-D: one canvas behind all panes, one renderer, a part of the canvas for each pane.

import { graphics } from "./painters.js";
import { Space } from "./paint/space.js";
import { isDark, onColours, readColours } from "./paint/palette.js";

/** By level of quality: pixels of the canvas for one of the page at most, and soft shadows. */
const qualities = [
  { ratio: 2, shadows: true },
  { ratio: 1, shadows: false },
  { ratio: 0.5, shadows: false },
];

/** Throws where the browser has no WebGL; three.js would complain in the console, too. */
export const makePainter = (container) => {
  const { webgl, software } = graphics();
  if (!webgl) throw new Error("no WebGL");
  const canvas = document.createElement("canvas");
  canvas.className = "space";
  canvas.setAttribute("aria-hidden", "true");
  const space = new Space(canvas, { antialias: !software });
  container.prepend(canvas);
  let quality = qualities[0];
  let lost = false;
  const recolour = () => space.setColours({ ...readColours(), dark: isDark() });
  recolour();
  onColours(recolour);

  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    lost = true;
  });
  canvas.addEventListener("webglcontextrestored", () => { lost = false; });

  const setLevel = (level) => {
    quality = qualities[level];
    space.setShadows(quality.shadows);
  };
  const startLevel = software ? qualities.length - 1 : 0;
  setLevel(startLevel);

  return {
    kind: "3-D",
    /** The quality to begin with, for a Rhythm; it may be set to another. */
    level: startLevel,
    setLevel,
    /**
     * `views`: {pane, scene, picture} of each world; where its `name(places)` is there, it is told
     * where the names of the picture belong.
     */
    paint(views, orbit) {
      if (lost) return;
      const whole = container.getBoundingClientRect();
      space.clear(whole.width, whole.height, Math.min(quality.ratio, devicePixelRatio));
      for (const { pane, scene, picture, name } of views) {
        const { left, bottom, width, height } = pane.getBoundingClientRect();
        if (width < 2 || height < 2) continue;
        const part = { left: left - whole.left, bottom: whole.bottom - bottom, width, height };
        const places = space.paint(part, scene, picture, orbit);
        name?.(places);
      }
    },
  };
};
