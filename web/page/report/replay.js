// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A replay out of a report's data, in the form in which painters take scenes and moments.

import { angleBetween, length, noTurn, subtract } from "../paint/vector.js";

/** A column of numbers: 16 bits each, low byte first; or one number for all. */
const unpack = (column, count) => {
  if (typeof column === "number") return new Float64Array(count).fill(column);
  const bytes = Uint8Array.from(atob(column.data), (digit) => digit.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Float64Array.from({ length: count }, (_, i) => view.getInt16(2 * i, true) * column.step);
};
const unpackAll = (columns, count) => Object.fromEntries(
  Object.entries(columns).map(([name, column]) => [name, unpack(column, count)]));

/** Of a rounded part `half` is the box within it: nothing in a sphere, a line in a capsule. */
const partOf = ({ at, q, half, rounding }) => {
  const edges = half.filter((edge) => edge > 1e-9).length;
  const whole = half.map((edge) => edge + rounding);
  const round = edges === 0 ? "sphere" : edges === 1 ? "capsule" : "box";
  return { shape: rounding > 0 ? round : "box", half: whole, at, turn: q };
};

/** As scene.js has them. */
const sceneOf = ({ bodies, shared, floor, hip_radius: hipRadius }) => ({
  bodies: bodies.map((body, id) => ({
    id, name: body.name, movable: body.movable, turns: body.turns, at: body.at, turn: body.q,
    parts: body.parts.map(partOf),
  })),
  shared: shared[0] ?? null,
  hipRadius,
  planes: [{ name: "platform", normal: [0, 1, 0], offset: floor }],
  fields: [],
});

const vectorAt = (columns, row) => [columns.x[row], columns.y[row], columns.z[row]];

export class Replay {
  constructor(data) {
    this.algorithm = data.algorithm;
    this.task = data.task;
    this.count = data.count;
    this.start = data.start_s;
    this.step = data.step_s;
    this.shared = data.shared;
    this.scene = sceneOf(data);
    this.sides = data.sides.map((side) => ({
      name: side.name,
      hand: unpackAll(side.hand, this.count),
      force: unpackAll(side.force, this.count),
      bodies: side.bodies.map((body) => unpackAll(body, this.count)),
    }));
    this.farthest = this.#farthestMoved();
  }

  timeAt(row) { return this.start + row * this.step; }

  #turnAt(body, columns, row) {
    if (!body.turns || !columns.qw) return body.turn;
    const turn = ["qw", "qx", "qy", "qz"].map((part) => columns[part][row]);
    const size = Math.hypot(...turn);
    return size > 0 ? turn.map((part) => part / size) : noTurn;
  }

  #poseAt(side, place, row) {
    const body = this.scene.bodies[this.shared[place]];
    const columns = side.bodies[place];
    return { at: vectorAt(columns, row), turn: this.#turnAt(body, columns, row) };
  }

  /** A Map of sides for pictureOf(), numbered by their places. */
  sidesAt(row) {
    const sides = this.sides.map((side, place) => [place, {
      id: place,
      place,
      hip: vectorAt(side.hand, row),
      force: vectorAt(side.force, row),
      bodies: new Map(this.shared.map((id, i) => [id, this.#poseAt(side, i, row)])),
    }]);
    return new Map(sides);
  }

  /** How far any two copies of any body are apart: {millimetres, degrees}. */
  apartAt(row) {
    const sides = [...this.sidesAt(row).values()];
    let [millimetres, radians] = [0, 0];
    sides.forEach((a, i) => sides.slice(i + 1).forEach((b) => this.shared.forEach((id) => {
      const [here, there] = [a.bodies.get(id), b.bodies.get(id)];
      millimetres = Math.max(millimetres, length(subtract(here.at, there.at)));
      if (this.scene.bodies[id].turns)
        radians = Math.max(radians, angleBetween(here.turn, there.turn));
    })));
    return { millimetres, degrees: (radians * 180) / Math.PI };
  }

  get turns() { return this.shared.some((id) => this.scene.bodies[id].turns); }

  /** Which of the shared bodies goes farthest along x: its curve is drawn. */
  #farthestMoved() {
    const spread = (column) => column.reduce((a, b) => Math.max(a, b), -Infinity)
      - column.reduce((a, b) => Math.min(a, b), Infinity);
    const ways = this.shared.map((_, i) =>
      Math.max(...this.sides.map((side) => spread(side.bodies[i].x))));
    return ways.indexOf(Math.max(...ways));
  }
}
