// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// One picture of one peer's world: what the painters draw. Lengths are in mm, forces in N.
// It holds solids {shape, half, at, turn, look, tint}, hands {at, radius, place, force, look},
// names {at, name, tint} of what has to be told apart, planes and fields as the scene has them. A
// tint is the name of a colour.

import { add, length, product, subtract, turned } from "./vector.js";

export const mmPerNewton = 25; // length of a force's arrow
const ghostFrom = 0.3; // mm: nearer copies hide each other
const ghostFromAngle = 0.01; // rad, in the square root of 1 - cos: about half a degree
const ghostsMax = 3;

const solidsOf = (body, pose, look, tint) =>
  body.parts.map((part) => ({
    shape: part.shape,
    half: part.half,
    at: add(pose.at, turned(pose.turn, part.at)),
    turn: product(pose.turn, part.turn),
    look,
    tint,
    body: body.id,
  }));

const differ = (a, b) => {
  if (length(subtract(a.at, b.at)) > ghostFrom) return true;
  const cosine = a.turn.reduce((sum, value, i) => sum + value * b.turn[i], 0);
  return Math.sqrt(Math.max(0, 1 - Math.abs(cosine))) > ghostFromAngle;
};

/** Where a body is in a peer's copy: as that peer says, or as the scene begins. */
export const poseOf = (body, side) => side?.bodies.get(body.id) ?? { at: body.at, turn: body.turn };

/** The others whose copies are shown in a peer's world: of more than three, the farthest. */
const othersOf = (scene, sides, own) => {
  const others = [...sides.values()].filter((side) => side.id !== own.id);
  if (others.length <= ghostsMax) return others;
  const apart = (side) =>
    Math.max(0, ...scene.bodies.filter((body) => body.movable).map((body) =>
      length(subtract(poseOf(body, side).at, poseOf(body, own).at))));
  return others.sort((a, b) => apart(b) - apart(a)).slice(0, ghostsMax);
};

/** Another's copy of a body, seen from here. The first shared one is compared at equal times. */
const ghostOf = (scene, body, own, other) => {
  const pose = poseOf(body, other);
  const offset = body.id === scene.shared ? own.offsets?.get(other.id) : undefined;
  return offset ? { at: add(poseOf(body, own).at, offset), turn: pose.turn } : pose;
};

/** `sides`: Map of {id, place, hip, force, bodies: Map of {at, turn}}, of one moment. */
export const pictureOf = (scene, sides, id) => {
  const own = sides.get(id);
  const solids = [];
  const hands = [];
  const names = [];
  for (const body of scene.bodies) {
    const look = body.movable ? "cube" : "static-cube";
    solids.push(...solidsOf(body, poseOf(body, own), look));
  }
  const picture = { solids, hands, names, planes: scene.planes, fields: scene.fields };
  if (own === undefined) return picture;
  for (const other of othersOf(scene, sides, own)) {
    for (const body of scene.bodies.filter((one) => one.movable)) {
      const pose = ghostOf(scene, body, own, other);
      if (differ(pose, poseOf(body, own))) solids.push(...solidsOf(body, pose, "ghost"));
    }
    if (other.hip) {
      hands.push({ at: other.hip, radius: scene.hipRadius, place: other.place, look: "ghost" });
    }
  }
  const shared = scene.bodies.find((body) => body.id === scene.shared);
  for (const { algorithm, tint, at } of shared ? own.beside ?? [] : []) {
    const pose = { at, turn: poseOf(shared, own).turn };
    if (!differ(pose, poseOf(shared, own))) continue;
    solids.push(...solidsOf(shared, pose, "ghost", tint));
    const high = Math.max(...shared.parts.map((part) => part.at[1] + part.half[1]));
    names.push({ name: algorithm, tint, at: add(at, [0, high, 0]) });
  }
  if (own.hip) {
    hands.push({
      at: own.hip, radius: scene.hipRadius, place: own.place, look: "hand", force: own.force,
    });
  }
  return picture;
};

/** The box around all that a scene holds at its beginning, with room for hands to move in. */
export const extentOf = (scene) => {
  const low = [-95, -20, -50];
  const high = [75, 60, 50];
  for (const body of scene.bodies) {
    for (const part of body.parts) {
      const radius = part.shape === "sphere" ? part.half[0] : length(part.half) / Math.sqrt(2);
      const centre = add(body.at, turned(body.turn, part.at));
      for (const axis of [0, 1, 2]) {
        low[axis] = Math.min(low[axis], centre[axis] - radius);
        high[axis] = Math.max(high[axis], centre[axis] + radius);
      }
    }
  }
  return { low, high };
};

/** Half of what a view of that aspect shows of the height at the scene's middle, mm. */
export const halfHeightOf = (scene, aspect) => {
  const { low, high } = extentOf(scene);
  const across = Math.hypot(high[0] - low[0], high[2] - low[2]) / 2 / aspect;
  return Math.max(across, 0.62 * (high[1] - low[1]) + 22) * 1.12;
};

/** The platform's height: that of the highest level plane, else the lowest point of the scene. */
export const floorOf = (scene) => {
  const level = scene.planes.filter((plane) => plane.normal[1] > 0.99).map((plane) => plane.offset);
  return level.length > 0 ? Math.max(...level) : extentOf(scene).low[1];
};
