// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The mouse as the hand of A, in virtual time, on the page of a real hapnet-web.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";

import { keepPicture, openPage, patience, programBeside } from "./browser.mjs";
import { assertLooks } from "./looks.mjs";
import { openVirtual } from "./virtual.mjs";

let [page, runs] = [null, 1];
const shown = openVirtual((opened) => { page = opened; });
const { skip, until, pace } = shown;

const cubeX = (place) => page.evaluate((at) =>
  globalThis.hapnet.model.frame.peers[at].cube[0] * 1000, place);
const view = () => page.locator('.pane[data-peer="1"] .view');

/** A session of 10 s over that network, with the hand of A in this page; it plays. */
const start = async (preset, task = "T1") => {
  await page.selectOption("#task", task);
  await page.click(`[data-preset="${preset}"]`);
  await page.selectOption("#device", "page");
  await page.click("#start");
  runs += 1;
  await until(([run, network]) => {
    const { state, frame } = globalThis.hapnet.model;
    return state.stage.run === run && state.stage.choice.preset === network
      && state.hand.peer === 1 && frame?.peers?.[0]?.session?.at_s > 0;
  }, [runs, preset]);
  await page.waitForSelector("#hand");
};

/** Drags by so many pixels to the right, in steps. */
const drag = async (pixels) => {
  await view().scrollIntoViewIfNeeded();
  const box = await view().boundingBox();
  const [x, y] = [box.x + box.width / 3, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await until(() => globalThis.hapnet.model.state.hand.held);
  for (let i = 1; i <= 30; i += 1) {
    await page.mouse.move(x + (pixels * i) / 30, y);
    await page.waitForTimeout(30);
  }
};

for (const [preset, lagMs] of [["ideal", 0], ["paper-delay-160", 160]]) {
  test(`the mouse pushes the cube over ${preset}, and the session repeats to the bit`, { skip },
    async () => {
      await start(preset);
      const before = await cubeX(0);
      // Seen while it is pushed: B's hand pushes it back later.
      const pushed = [0, 1].map((place) => until(([at, from]) =>
        globalThis.hapnet.model.frame.peers[at].cube[0] * 1000 > from + 5, [place, before]));
      await Promise.all([drag(220), ...pushed]);
      assert.match(await page.textContent("#hand-force"), /force on the hand \d+\.\d\d N/);
      await keepPicture(page, `hand-${lagMs}`);
      await page.mouse.up();
      await until(() => !globalThis.hapnet.model.state.hand.held);
      await page.selectOption("#factor", "max");
      await until(() => globalThis.hapnet.model.state.pace.state === "ended");
      const played = await pace();
      await page.click("#save");
      await until((run) => globalThis.hapnet.model.events.filter((event) =>
        event.kind === "pace" && event.files?.length === 1).length === run - 1, runs);
      await page.selectOption("#factor", "1");
      // The folder may be elsewhere: the experiment names the way of the hand from where it lies.
      const elsewhere = mkdtempSync(join(tmpdir(), "hapnet-elsewhere-"));
      cpSync(join(shown.web.out, `run-${runs}`), elsewhere, { recursive: true });
      rmSync(join(shown.web.out, `run-${runs}`, "experiment-1-hand.csv"));
      const file = join(elsewhere, "experiment-1.toml");
      assert.match(readFileSync(file, "utf8"), /replay = \["experiment-1-hand\.csv", ""\]/);
      const again = JSON.parse(execFileSync(programBeside("hapnet-lab"), ["play", file, "--json"],
        { encoding: "utf8" }));
      rmSync(elsewhere, { recursive: true });
      assert.equal(again.digest, played.digest);
      assert.deepEqual(page.complaints, []);
    });
}

test("one page holds the hand, others are told that they watch", { skip }, async () => {
  await start("paper-delay-160");
  const other = await openPage(await shown.browser.newContext(), shown.web.address);
  await other.waitForSelector("#hand");
  await page.click("#hand button");
  await until(() => globalThis.hapnet.model.state.hand.held);
  await other.click("#hand button");
  await other.waitForFunction(() => /another page holds the hand/
    .test(document.getElementById("hand-says").textContent), undefined, patience);
  assert.equal(await other.getAttribute("#hand button", "aria-pressed"), "false");
  assert.equal(await page.getAttribute("#hand button", "aria-pressed"), "true");
  await page.keyboard.press("Escape");
  await until(() => !globalThis.hapnet.model.state.hand.held);
  await other.click("#hand button");
  await until(() => globalThis.hapnet.model.state.hand.held);
  await other.close(); // which frees it
  await until(() => !globalThis.hapnet.model.state.hand.held);
});

test("the arrow keys move the hand, and its force is told", { skip }, async () => {
  await start("ideal");
  await view().focus();
  const hip = () => page.evaluate(() => globalThis.hapnet.model.frame.peers[0].hip[0] * 1000);
  const before = await hip();
  for (let i = 0; i < 10; i += 1) await page.keyboard.press("ArrowLeft");
  await until((from) => globalThis.hapnet.model.frame.peers[0].hip[0] * 1000 < from - 10, before);
  await page.keyboard.press("Escape");
  await until(() => !globalThis.hapnet.model.state.hand.held);
  assert.deepEqual(page.complaints, []);
});

const hip = (axis) => page.evaluate((at) =>
  globalThis.hapnet.model.frame.peers[0].hip[at] * 1000, axis);
const middle = async () => {
  await view().scrollIntoViewIfNeeded();
  const box = await view().boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
};

test("the hand does not move while the pointer that takes it rests", { skip }, async () => {
  await start("ideal");
  const [x, y] = await middle();
  const before = [await hip(0), await hip(1), await hip(2)];
  const orbit = () => page.evaluate(() => {
    const { yaw, pitch, zoom } = globalThis.hapnet.orbit;
    return [yaw, pitch, zoom];
  });
  const view3d = await orbit();
  await page.mouse.dblclick(x, y);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await until(() => globalThis.hapnet.model.state.hand.held);
  await page.waitForTimeout(300);
  for (const axis of [0, 1, 2])
    assert.ok(Math.abs(await hip(axis) - before[axis]) < 0.01, `axis ${axis}`);
  assert.deepEqual(await orbit(), view3d, "nor does the view");
  await page.mouse.up();
  await until(() => !globalThis.hapnet.model.state.hand.held);
});

test("the wheel moves the hand along the third axis while it is held", { skip }, async () => {
  await start("ideal");
  const [x, y] = await middle();
  const before = await hip(2);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await until(() => globalThis.hapnet.model.state.hand.held);
  await page.mouse.wheel(0, 200); // 10 mm
  await until((from) => globalThis.hapnet.model.frame.peers[0].hip[2] * 1000 > from + 9.9, before);
  assert.ok(Math.abs(await hip(2) - before - 10) < 0.1, `${await hip(2) - before} mm`);
  await page.mouse.up();
  await until(() => !globalThis.hapnet.model.state.hand.held);
});

test("a finger moves the hand, and the page does not scroll", { skip }, async () => {
  await start("ideal");
  const context = await shown.browser.newContext({ hasTouch: true,
    viewport: { width: 390, height: 844 } });
  const phone = await openPage(context, shown.web.address);
  await phone.waitForSelector("#hand");
  const where = phone.locator('.pane[data-peer="1"] .view');
  await where.scrollIntoViewIfNeeded();
  const box = await where.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const scrolled = await phone.evaluate(() => scrollY);
  const before = [await hip(0), await hip(1)];
  const finger = await context.newCDPSession(phone);
  const touch = (type, ...points) =>
    finger.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  await touch("touchStart", { x, y });
  await until(() => globalThis.hapnet.model.state.hand.held);
  for (let i = 1; i <= 15; i += 1) {
    await touch("touchMove", { x: x - 2 * i, y: y - 2 * i });
    await phone.waitForTimeout(30);
  }
  await until(([right, up]) => {
    const at = globalThis.hapnet.model.frame.peers[0].hip;
    return at[0] * 1000 < right - 8 && at[1] * 1000 > up + 8;
  }, before);
  assert.equal(await phone.evaluate(() => scrollY), scrolled);
  await touch("touchEnd");
  await until(() => !globalThis.hapnet.model.state.hand.held);
  assert.deepEqual(phone.complaints, []);
  await context.close();
});

test("a hand that grips carries the cube of P1 both ways", { skip }, async () => {
  await start("ideal", "P1");
  await view().focus();
  const xs = () => page.evaluate(() => {
    const { hip: [hand], cube: [cube] } = globalThis.hapnet.model.frame.peers[0];
    return [hand * 1000, cube * 1000];
  });
  const press = async (key, times) => {
    for (let i = 0; i < times; i += 1) await page.keyboard.press(key);
  };
  let [hand, cube] = await xs();
  await press("ArrowRight", Math.ceil((cube - 24 - hand) / 2)); // to its left face
  await until((to) => globalThis.hapnet.model.frame.peers[0].hip[0] * 1000 > to, cube - 27);
  await page.keyboard.press("g");
  assert.equal(await page.textContent('#hand [aria-pressed="true"]:last-of-type'), "Grip");
  [hand, cube] = await xs();
  await press("ArrowLeft", 15); // 30 mm: a hand that only pushes would leave it behind
  await until((from) => globalThis.hapnet.model.frame.peers[0].cube[0] * 1000 < from - 15, cube);
  await press("ArrowRight", 15);
  await until((to) => globalThis.hapnet.model.frame.peers[0].cube[0] * 1000 > to, cube - 8);
  await assertLooks(page, { figures: null, seen: (view) => keepPicture(page, `grip-${view}`) });
  await page.keyboard.press("Escape");
  await until(() => !globalThis.hapnet.model.state.hand.held);
  assert.deepEqual(page.complaints, []);
});
