// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Geometries of the solids that scenes know, for three.js, which the caller hands in.

/** A box with rounded edges: the corners of a finely cut cube, moved out to where they belong. */
const roundedBox = (three, half, radius) => {
  const cuts = 7; // odd: three rounds of vertices for each corner
  const geometry = new three.BoxGeometry(1, 1, 1, cuts, cuts, cuts);
  const { position, normal } = geometry.attributes;
  const inner = half.map((edge) => edge - radius);
  const vertex = new three.Vector3();
  for (let i = 0; i < position.count; i += 1) {
    vertex.fromBufferAttribute(position, i);
    const signs = [Math.sign(vertex.x), Math.sign(vertex.y), Math.sign(vertex.z)];
    const from = 0.5 / cuts; // of the middle cut, which stretches along the edge
    vertex.set(vertex.x - from * signs[0], vertex.y - from * signs[1], vertex.z - from * signs[2]);
    vertex.normalize();
    normal.setXYZ(i, vertex.x, vertex.y, vertex.z);
    position.setXYZ(i, ...[vertex.x, vertex.y, vertex.z].map((along, axis) =>
      signs[axis] * inner[axis] + along * radius));
  }
  return geometry;
};

/** Turned about y, and then laid along its longest edge. */
const capsule = (three, half) => {
  const axis = half.indexOf(Math.max(...half));
  const radius = Math.min(...half);
  const outline = Array.from({ length: 18 }, (_, i) => { // nine points of each cap
    const angle = (Math.PI / 16) * (i < 9 ? i - 8 : i - 9);
    const reach = (half[axis] - radius) * (i < 9 ? -1 : 1);
    return new three.Vector2(radius * Math.cos(angle), reach + radius * Math.sin(angle));
  });
  const geometry = new three.LatheGeometry(outline, 24);
  if (axis === 0) geometry.rotateZ(Math.PI / 2);
  if (axis === 2) geometry.rotateX(Math.PI / 2);
  return geometry;
};

export const solidGeometry = (three, shape, half) => {
  if (shape === "sphere") return new three.SphereGeometry(half[0], 32, 20);
  if (shape === "capsule") return capsule(three, half);
  return roundedBox(three, half, Math.min(2, 0.25 * Math.min(...half)));
};

/** The lines that show a solid's outline. */
export const solidEdges = (three, shape, half) => {
  if (shape !== "box") return new three.WireframeGeometry(new three.SphereGeometry(half[0], 8, 6));
  const box = new three.BoxGeometry(...half.map((edge) => 2 * edge));
  return new three.EdgesGeometry(box);
};
