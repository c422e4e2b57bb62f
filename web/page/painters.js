// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Chooses the painter of worlds: three.js with WebGL, on a graphics card or the processor as the
// browser reports, or a still picture.

const probe = () => {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return { webgl: false, software: false };
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  const software = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
  return { webgl: true, software };
};

let found = null;

/** {webgl, software}: whether there is WebGL, and whether it is the processor that draws it. */
export const graphics = () => {
  found ??= probe();
  return found;
};

/**
 * The flat context of a canvas. Where the processor draws, it keeps its pixels in memory: drawn as
 * if by a card, such canvases took half of the time of a picture.
 */
export const flatContext = (canvas) =>
  canvas.getContext("2d", graphics().software ? { willReadFrequently: true } : {});

/**
 * The painter of worlds in space, or a still picture where three.js or WebGL is missing.
 * `hasThree`: it is worth asking for three.js, whose absence the browser would log.
 */
export const painterFor = async (container, hasThree = true) => {
  try {
    if (!hasThree) throw new Error("no three.js");
    return (await import("./scene3d.js")).makePainter(container);
  } catch {
    container.querySelector("canvas.space")?.remove();
    return (await import("./scenestill.js")).makePainter(container);
  }
};
