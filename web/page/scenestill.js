// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Without WebGL or three.js: a still picture of each world at its start, seen from the front, and a
// text with the present places of the bodies and the hand.

import { make, say } from "./dom.js";
import { drawing, element, paintOf } from "./figures/svg.js";
import { extentOf, floorOf, pictureOf } from "./paint/picture.js";

const betweenMs = 250; // between two texts: faster than one reads

const stillOf = (scene) => {
  const { low, high } = extentOf(scene);
  const [width, height] = [high[0] - low[0], high[1] - low[1]];
  const svg = drawing({ width, height }, "The world as it begins, seen from the front");
  const floor = high[1] - floorOf(scene);
  element(svg, "path", { d: `M0 ${floor}H${width}`, stroke: paintOf("edge"), "stroke-width": 1 });
  for (const { at, half, look } of pictureOf(scene, new Map(), null).solids) {
    element(svg, "rect", {
      x: at[0] - half[0] - low[0], y: high[1] - at[1] - half[1], width: 2 * half[0],
      height: 2 * half[1], fill: paintOf(look),
    });
  }
  return svg;
};

const placeOf = (at) => at.map((value) => value.toFixed(1)).join(", ");

/** "cube at 1.0, 0.0, 0.0 mm; hand at ..." */
const wordsOf = (scene, { solids, hands, names }) => {
  const nameOf = ({ body }) => scene.bodies.find((one) => one.id === body)?.name || "body";
  const bodies = solids.filter((solid) => solid.look === "cube")
    .map((solid) => `${nameOf(solid)} at ${placeOf(solid.at)} mm`);
  const own = hands.filter((hand) => hand.look === "hand")
    .map((hand) => `hand at ${placeOf(hand.at)} mm`);
  const others = names.map(({ name, at }) => `with ${name} its top at ${placeOf(at)} mm`);
  return [...bodies, ...others, ...own].join("; ");
};

export const makePainter = () => {
  const shown = new WeakMap(); // of each pane {scene, words}
  let last = -Infinity;

  const setUp = (pane, scene) => {
    const words = make("p", { class: "in-words" });
    pane.replaceChildren(stillOf(scene), words);
    shown.set(pane, { scene, words });
  };

  return {
    kind: "still",
    level: 0,
    setLevel() {},
    paint(views) {
      const isTime = performance.now() - last >= betweenMs;
      if (isTime) last = performance.now();
      for (const { pane, scene, picture } of views) {
        const isNew = shown.get(pane)?.scene !== scene;
        if (isNew) setUp(pane, scene);
        if (isTime || isNew) say(shown.get(pane).words, wordsOf(scene, picture));
      }
    },
  };
};
