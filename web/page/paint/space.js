// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Paints a picture in space with three.js: one set of objects, posed anew for each picture.

import * as three from "../three.module.min.js";
import { extentOf, floorOf, halfHeightOf, mmPerNewton } from "./picture.js";
import { colourOfPeer } from "./palette.js";
import { solidEdges, solidGeometry } from "./solids.js";
import { length } from "./vector.js";

const up = new three.Vector3(0, 1, 0);
const [fieldOfView, shadowSize] = [26, 1024];

const lightsOf = () => {
  const sky = new three.HemisphereLight(0xffffff, 0x8895a5, 1.5);
  const sun = new three.DirectionalLight(0xffffff, 2.1);
  sun.position.set(-110, 320, 190);
  sun.castShadow = true;
  sun.shadow.mapSize.set(shadowSize, shadowSize);
  Object.assign(sun.shadow.camera, {
    left: -230, right: 230, top: 230, bottom: -230, near: 50, far: 800,
  });
  sun.shadow.radius = 5;
  sun.shadow.bias = -0.0006;
  sun.shadow.normalBias = 0.6;
  return [sky, sun];
};

export class Space {
  #world = new three.Scene();
  #camera = new three.PerspectiveCamera(fieldOfView, 1, 20, 6000);
  #lent = [];
  #pools = new Map();
  #geometries = new Map();
  #materials = new Map();
  #ground = null;
  #scene = null;

  constructor(canvas, { antialias }) {
    this.renderer = new three.WebGLRenderer({ canvas, alpha: true, antialias });
    this.renderer.setScissorTest(true);
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = three.PCFShadowMap;
    this.#world.add(...lightsOf());
  }

  /** Colours by name; the materials are made anew. */
  setColours(colours) {
    this.colours = colours;
    this.#materials.forEach((material) => material.dispose());
    this.#materials.clear();
    this.#pools.forEach((pool) => pool.forEach((object) => this.#world.remove(object)));
    this.#pools.clear();
    this.#scene = null;
  }

  setShadows(on) {
    if (on === this.renderer.shadowMap.enabled) return;
    this.renderer.shadowMap.enabled = on;
    this.#materials.forEach((material) => { material.needsUpdate = true; });
  }

  #kept(store, key, make) {
    if (!store.has(key)) store.set(key, make());
    return store.get(key);
  }

  /** `tint` is the colour of what has another one than usual. */
  #material(look, tint) {
    return this.#kept(this.#materials, `${look}:${tint}`, () => {
      if (look === "edge") {
        return new three.LineDashedMaterial({
          color: this.colours[tint ?? "ink"], dashSize: 3.5, gapSize: 2.5, transparent: true,
          opacity: 0.8,
        });
      }
      if (look === "ghost") {
        return new three.MeshBasicMaterial({
          color: this.colours[tint ?? "cube"], transparent: true, opacity: 0.16, depthWrite: false,
        });
      }
      if (look === "grid") return new three.LineBasicMaterial({ color: this.colours.line });
      return new three.MeshStandardMaterial({ color: this.colours[look], roughness: 0.62 });
    });
  }

  /** An object out of the pool of its kind, which goes back before the next picture. */
  #lend(key, make) {
    const pool = this.#kept(this.#pools, key, () => []);
    let object = pool.find((one) => !one.visible);
    if (!object) {
      object = make();
      pool.push(object);
      this.#world.add(object);
    }
    object.visible = true;
    this.#lent.push(object);
    return object;
  }

  #mesh(shape, half, look, tint) {
    const key = `${shape}:${half.map((edge) => edge.toFixed(3))}`;
    return this.#lend(`${key}:${look}:${tint}`, () => {
      const geometry = this.#kept(this.#geometries, key, () => solidGeometry(three, shape, half));
      const mesh = new three.Mesh(geometry, this.#material(look, tint));
      mesh.castShadow = mesh.receiveShadow = look !== "ghost";
      return mesh;
    });
  }

  #edges(shape, half, tint) {
    const key = `edges:${shape}:${half.map((edge) => edge.toFixed(3))}`;
    return this.#lend(`${key}:${tint}`, () => {
      const geometry = this.#kept(this.#geometries, key, () => solidEdges(three, shape, half));
      const lines = new three.LineSegments(geometry, this.#material("edge", tint));
      lines.computeLineDistances();
      return lines;
    });
  }

  #pose(object, { at, turn }) {
    object.position.set(...at);
    if (turn) object.quaternion.set(turn[1], turn[2], turn[3], turn[0]);
  }

  #paintSolid(solid) {
    const { shape, half, look, tint } = solid;
    this.#pose(this.#mesh(shape, half, look, tint), solid);
    if (look === "ghost") this.#pose(this.#edges(shape, half, tint), solid);
  }

  #arrow(from, force, look) {
    const newtons = length(force);
    if (newtons < 0.02) return;
    const arrow = this.#lend(`arrow:${look}`, () => {
      const material = this.#material(look);
      const group = new three.Group();
      const shaft = new three.Mesh(new three.CylinderGeometry(1.3, 1.3, 1, 12), material);
      const head = new three.Mesh(new three.ConeGeometry(3.6, 9, 20), material);
      shaft.castShadow = head.castShadow = true;
      group.add(shaft, head);
      return group;
    });
    const [shaft, head] = arrow.children;
    const size = newtons * mmPerNewton;
    const tip = Math.min(9, size);
    head.scale.setScalar(tip / 9);
    head.position.y = size - tip / 2;
    shaft.scale.y = Math.max(0.01, size - tip);
    shaft.position.y = shaft.scale.y / 2;
    arrow.position.set(...from);
    arrow.quaternion.setFromUnitVectors(up, new three.Vector3(...force).normalize());
  }

  #paintHand(hand) {
    const look = hand.look === "ghost" ? "ghost" : colourOfPeer(hand.place);
    const half = [hand.radius, hand.radius, hand.radius];
    this.#pose(this.#mesh("sphere", half, look), { at: hand.at });
    if (hand.look === "ghost") this.#pose(this.#edges("sphere", half), { at: hand.at });
    const above = [hand.at[0], hand.at[1] + hand.radius + 8, hand.at[2]];
    if (hand.force) this.#arrow(above, hand.force, "ink");
  }

  #paintField(field) {
    if (field.half) this.#pose(this.#edges("box", field.half), field);
    this.#arrow(field.at, field.force, "other");
  }

  /** The platform: a slab with a grid of 20 mm on it. */
  #setGround(scene) {
    if (this.#scene === scene) return;
    this.#scene = scene;
    if (this.#ground) this.#world.remove(this.#ground);
    const { low, high } = extentOf(scene);
    const floor = floorOf(scene);
    const [left, right] = [Math.min(-120, low[0]) - 20, Math.max(160, high[0]) + 20];
    const depth = 2 * Math.max(70, high[2] + 20, 20 - low[2]);
    const box = new three.BoxGeometry(right - left, 6, depth);
    const slab = new three.Mesh(box, this.#material("card"));
    slab.position.set((left + right) / 2, floor - 3.05, 0);
    slab.receiveShadow = true;
    const points = [];
    for (let x = Math.ceil(left / 20) * 20; x <= right; x += 20) {
      points.push(x, floor, -depth / 2, x, floor, depth / 2);
    }
    for (let z = -Math.floor(depth / 40) * 20; z <= depth / 2; z += 20) {
      points.push(left, floor, z, right, floor, z);
    }
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.Float32BufferAttribute(points, 3));
    this.#ground = new three.Group();
    this.#ground.add(slab, new three.LineSegments(geometry, this.#material("grid")));
    this.#world.add(this.#ground);
  }

  #aim(scene, orbit, aspect) {
    const { low, high } = extentOf(scene);
    const centre = low.map((value, axis) => (value + high[axis]) / 2);
    const half = halfHeightOf(scene, aspect);
    const distance = half / Math.tan((fieldOfView * Math.PI) / 360) / orbit.zoom;
    const level = Math.cos(orbit.pitch) * distance;
    this.#camera.aspect = aspect;
    this.#camera.position.set(centre[0] + Math.sin(orbit.yaw) * level,
      centre[1] + Math.sin(orbit.pitch) * distance, centre[2] + Math.cos(orbit.yaw) * level);
    this.#camera.lookAt(...centre);
    this.#camera.updateProjectionMatrix();
  }

  clear(width, height, ratio) {
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.renderer.setScissor(0, 0, width, height);
    this.renderer.clear();
  }

  /**
   * Paints the picture into a part of the canvas: {left, bottom, width, height}, in CSS pixels.
   * Gives where its names belong in that part, from its top left: [{left, top}].
   */
  paint({ left, bottom, width, height }, scene, picture, orbit) {
    this.#lent.forEach((object) => { object.visible = false; });
    this.#lent = [];
    this.#setGround(scene);
    picture.solids.forEach((solid) => this.#paintSolid(solid));
    picture.hands.forEach((hand) => this.#paintHand(hand));
    picture.fields.forEach((field) => this.#paintField(field));
    this.#aim(scene, orbit, width / height);
    this.renderer.setViewport(left, bottom, width, height);
    this.renderer.setScissor(left, bottom, width, height);
    this.renderer.render(this.#world, this.#camera);
    return picture.names.map(({ at }) => {
      const { x, y } = new three.Vector3(...at).project(this.#camera);
      return { left: ((x + 1) / 2) * width, top: ((1 - y) / 2) * height };
    });
  }
}
