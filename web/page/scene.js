// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A scene as the server describes it, in the form and the millimetres in which painters take it.

import { noTurn } from "./paint/vector.js";

export const millimetres = (metres) => metres.map((value) => value * 1000);

const partOf = (piece) => ({
  shape: piece.shape ?? "box",
  half: millimetres(piece.half ?? [0.02, 0.02, 0.02]),
  at: millimetres(piece.position ?? [0, 0, 0]),
  turn: piece.orientation ?? noTurn,
});

/** The first part stands where the body is; the others are given in its frame. */
const bodyOf = (body) => {
  const first = partOf({ ...body, position: [0, 0, 0], orientation: noTurn });
  return {
    id: body.body,
    name: body.name || `body ${body.body}`,
    movable: Boolean(body.movable),
    at: millimetres(body.position ?? [0, 0, 0]),
    turn: body.orientation ?? noTurn,
    parts: [first, ...(body.parts ?? []).map(partOf)],
  };
};

const fieldOf = (field) => ({
  name: field.name ?? "",
  at: millimetres(field.position ?? [0, 0, 0]),
  half: field.half ? millimetres(field.half) : null,
  force: field.force ?? [0, 0, 0],
  line: field.line ?? null,
});

/** The paper's scene, for the time before any peer has described its own. */
const paper = {
  name: "paper",
  bodies: [
    { body: 0, name: "cube", half: [0.02, 0.02, 0.02], movable: true, shared: true },
    { body: 1, name: "static cube", half: [0.02, 0.02, 0.02], position: [0.1147, 0, 0.03] },
  ],
  hips: { radius: 0.005 },
  planes: [{ name: "platform", normal: [0, 1, 0], offset: -0.02 }],
};

export const sceneOf = (reply) => {
  const said = reply?.bodies?.length > 0 ? reply : paper;
  const bodies = said.bodies.map(bodyOf);
  return {
    name: said.name ?? "",
    hash: said.hash ?? "",
    bodies,
    shared: bodies.find((body) => body.movable)?.id ?? null,
    hipRadius: 1000 * (said.hips?.radius ?? 0.005),
    planes: (said.planes ?? []).map((plane) => ({
      name: plane.name ?? "", normal: plane.normal, offset: 1000 * plane.offset,
    })),
    fields: (said.fields ?? []).map(fieldOf),
  };
};

