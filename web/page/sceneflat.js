// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The worlds in an oblique view, a canvas in each pane: where there is no WebGL, or no three.js.

import { paintFlat } from "./paint/flat.js";
import { onColours, readColours } from "./paint/palette.js";

const canvasOf = (pane) => {
  const found = pane.querySelector("canvas");
  if (found) return found;
  const canvas = document.createElement("canvas");
  canvas.setAttribute("aria-hidden", "true");
  pane.prepend(canvas);
  return canvas;
};

export const makePainter = () => {
  let colours = readColours();
  onColours(() => {
    colours = readColours();
  });
  return {
    kind: "flat",
    level: 0,
    setLevel() {},
    paint(views) {
      for (const { pane, scene, picture } of views) {
        const canvas = canvasOf(pane);
        const { clientWidth: width, clientHeight: height } = pane;
        if (width < 2 || height < 2) continue;
        const ratio = Math.min(2, devicePixelRatio);
        if (
          canvas.width !== Math.round(width * ratio) ||
          canvas.height !== Math.round(height * ratio)
        ) {
          Object.assign(canvas, { width: width * ratio, height: height * ratio });
        }
        const context = canvas.getContext("2d");
        context.setTransform(ratio, 0, 0, ratio, 0, 0);
        paintFlat(context, { width, height }, scene, picture, colours);
      }
    },
  };
};
