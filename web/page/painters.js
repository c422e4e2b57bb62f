// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Which painters there are here: with the modules and WebGL the good ones, else those of our own.

/** The painter of worlds in space, or the flat one where modules or WebGL are missing. */
export const painterFor = async (container) => {
  try {
    return (await import("./scene3d.js")).makePainter(container);
  } catch {
    container.querySelector("canvas.space")?.remove();
    return (await import("./sceneflat.js")).makePainter(container);
  }
};

/** The function makeChart of charts.js, or that of strips.js. */
export const chartMaker = async () => {
  try {
    return (await import("./charts.js")).makeChart;
  } catch {
    return (await import("./strips.js")).makeChart;
  }
};
