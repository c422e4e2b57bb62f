// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Debian's three.js, as cmake/HapnetPage.cmake makes it a module, has all that the painters use.

import assert from "node:assert/strict";
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";

import { solidEdges, solidGeometry } from "../../web/page/paint/solids.js";

const script = "/usr/share/javascript/three/three.min.js";
const repository = new URL("../../", import.meta.url);
const painters = new URL("web/page/paint/", repository);

const namesOfPainters = () => {
  const names = new Set(["REVISION"]);
  for (const file of readdirSync(painters)) {
    const text = readFileSync(new URL(file, painters), "utf8");
    for (const [, name] of text.matchAll(/three\.([A-Z]\w+)/g)) names.add(name);
  }
  return [...names];
};

test("loads in space with Debian's three.js", { skip: !existsSync(script) }, async (context) => {
  const folder = mkdtempSync(join(tmpdir(), "hapnet-three-"));
  context.after(() => rmSync(folder, { recursive: true }));
  const names = namesOfPainters();
  const end = readFileSync(new URL("cmake/debian_three.js.in", repository), "utf8");
  const module = join(folder, "three.mjs");
  writeFileSync(module, readFileSync(script, "utf8") + end.replace("@names@", names.join(", ")));
  const three = await import(module);
  for (const name of names) assert.notEqual(three[name], undefined, name);
  for (const shape of ["box", "sphere", "capsule"]) {
    const geometry = solidGeometry(three, shape, [20, 10, 10]);
    geometry.computeBoundingBox();
    const { min, max } = geometry.boundingBox;
    assert.ok(Math.abs(max.x - 20) < 0.5, `${shape} reaches ${max.x}`);
    assert.ok(Math.abs(min.x + max.x) < 1e-3, shape);
    assert.ok(solidEdges(three, shape, [20, 10, 10]).attributes.position.count > 0);
  }
});
