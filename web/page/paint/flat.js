// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Paints a picture on a Canvas 2-D context, without any library.

import { obliqueView, towardViewer } from "./oblique.js";
import { floorOf, mmPerNewton } from "./picture.js";
import { colourOfPeer } from "./palette.js";
import { add, dot, length, scaled, subtract, turned } from "./vector.js";

const trace = (context, points) => {
  context.beginPath();
  points.forEach((point) => context.lineTo(...point));
};

const faces = [
  { axis: 0, sign: 1 },
  { axis: 0, sign: -1 },
  { axis: 1, sign: 1 },
  { axis: 1, sign: -1 },
  { axis: 2, sign: 1 },
  { axis: 2, sign: -1 },
];

/** The faces of a turned box that point to the viewer, each with its corners and its normal. */
const facesOf = (solid) => {
  const seen = [];
  for (const { axis, sign } of faces) {
    const [u, v] = [0, 1, 2].filter((other) => other !== axis);
    const unit = [0, 0, 0];
    unit[axis] = sign;
    const normal = turned(solid.turn, unit);
    if (dot(normal, towardViewer) <= 1e-9) continue;
    const corners = [
      [-1, -1],
      [1, -1],
      [1, 1],
      [-1, 1],
    ].map(([a, b]) => {
      const corner = [0, 0, 0];
      corner[axis] = sign * solid.half[axis];
      corner[u] = a * solid.half[u];
      corner[v] = b * solid.half[v];
      return add(solid.at, turned(solid.turn, corner));
    });
    seen.push({ corners, normal });
  }
  return seen;
};

const shadeOf = (normal) => 0.26 * (1 - Math.max(0, dot(normal, [0.25, 0.9, 0.35])));

const paintBox = (context, view, solid, style) => {
  for (const { corners, normal } of facesOf(solid)) {
    trace(context, corners.map(view.project));
    context.closePath();
    if (style.fill) {
      context.fillStyle = style.fill;
      context.fill();
      context.fillStyle = `rgba(0, 0, 0, ${shadeOf(normal)})`;
      context.fill();
    }
    context.stroke();
  }
};

const paintBall = (context, view, at, radius, style) => {
  const [x, y] = view.project(at);
  context.beginPath();
  context.arc(x, y, radius * view.scale, 0, 2 * Math.PI);
  if (style.fill) {
    context.fillStyle = style.fill;
    context.fill();
  }
  context.stroke();
};

/** A capsule lies along its longest axis: a wide line with round ends. */
const paintCapsule = (context, view, solid, style) => {
  const axis = solid.half.indexOf(Math.max(...solid.half));
  const radius = Math.min(...solid.half);
  const along = [0, 0, 0];
  along[axis] = solid.half[axis] - radius;
  const reach = turned(solid.turn, along);
  const ends = [subtract(solid.at, reach), add(solid.at, reach)].map(view.project);
  const lines = [[2 * radius * view.scale, context.strokeStyle]];
  if (style.fill) lines.push([2 * radius * view.scale - 2 * context.lineWidth, style.fill]);
  context.lineCap = "round";
  for (const [width, colour] of style.fill ? lines : [[2, context.strokeStyle]]) {
    trace(context, ends);
    Object.assign(context, { lineWidth: Math.max(1, width), strokeStyle: colour });
    context.stroke();
  }
};

const paintSolid = (context, view, solid, colours) => {
  context.save();
  const ghost = solid.look === "ghost";
  Object.assign(context, { strokeStyle: colours.ink, lineWidth: ghost ? 1.5 : 1.25 });
  if (ghost) context.setLineDash([6, 5]);
  const style = { fill: ghost ? null : colours[solid.look] };
  if (solid.shape === "sphere") paintBall(context, view, solid.at, solid.half[0], style);
  else if (solid.shape === "capsule") paintCapsule(context, view, solid, style);
  else paintBox(context, view, solid, style);
  context.restore();
};

export const paintArrow = (context, from, to, colour) => {
  const way = [to[0] - from[0], to[1] - from[1]];
  const size = Math.hypot(...way);
  if (size < 3) return;
  const head = Math.min(11, size);
  const unit = [way[0] / size, way[1] / size];
  const barb = (side) => [
    to[0] - head * unit[0] + side * 0.6 * head * unit[1],
    to[1] - head * unit[1] - side * 0.6 * head * unit[0],
  ];
  context.save();
  Object.assign(context, {
    strokeStyle: colour,
    lineWidth: 3,
    lineCap: "round",
    lineJoin: "round",
  });
  trace(context, [from, to]);
  context.stroke();
  trace(context, [barb(1), to, barb(-1)]);
  context.stroke();
  context.restore();
};

const paintHand = (context, view, hand, colours) => {
  context.save();
  const ghost = hand.look === "ghost";
  Object.assign(context, { strokeStyle: ghost ? colours.muted : colours.ink, lineWidth: 1.5 });
  if (ghost) context.setLineDash([3, 3]);
  const fill = ghost ? null : colours[colourOfPeer(hand.place)];
  paintBall(context, view, hand.at, hand.radius, { fill });
  context.restore();
  if (!hand.force || length(hand.force) < 0.02) return;
  const lift = add(hand.at, [0, hand.radius + 8, 0]); // above the hand, where nothing hides it
  const end = add(lift, scaled(hand.force, mmPerNewton));
  paintArrow(context, view.project(lift), view.project(end), colours.ink);
};

const paintFloor = (context, view, floor, colours) => {
  context.strokeStyle = colours.line;
  context.lineWidth = 1;
  const lines = [];
  for (let x = -120; x <= 180; x += 20)
    lines.push([
      [x, floor, -60],
      [x, floor, 60],
    ]);
  for (let z = -60; z <= 60; z += 20)
    lines.push([
      [-120, floor, z],
      [180, floor, z],
    ]);
  for (const line of lines) {
    trace(context, line.map(view.project));
    context.stroke();
  }
};

/** A field: its region as a dotted box, and its force as an arrow. */
const paintField = (context, view, field, colours) => {
  context.save();
  Object.assign(context, { strokeStyle: colours.other, lineWidth: 1 });
  context.setLineDash([2, 4]);
  if (field.half) paintBox(context, view, { ...field, turn: [1, 0, 0, 0] }, {});
  if (field.line) {
    const ends = [-60, 60].map((reach) => add(field.at, scaled(field.line, reach)));
    trace(context, ends.map(view.project));
    context.stroke();
  }
  context.restore();
  if (length(field.force) < 0.02) return;
  const tip = add(field.at, scaled(field.force, mmPerNewton));
  paintArrow(context, view.project(field.at), view.project(tip), colours.other);
};

const depth = (solid) => dot(solid.at, towardViewer);

/** Paints the picture over the whole of a canvas of width x height pixels. */
export const paintFlat = (context, { width, height }, scene, picture, colours) => {
  const view = obliqueView(scene, width, height);
  context.clearRect(0, 0, width, height);
  paintFloor(context, view, floorOf(scene), colours);
  picture.fields.forEach((field) => paintField(context, view, field, colours));
  const solids = [...picture.solids].sort((a, b) => depth(a) - depth(b));
  solids
    .filter((solid) => solid.look !== "ghost")
    .forEach((solid) => paintSolid(context, view, solid, colours));
  solids
    .filter((solid) => solid.look === "ghost")
    .forEach((solid) => paintSolid(context, view, solid, colours));
  picture.hands.forEach((hand) => paintHand(context, view, hand, colours));
};
