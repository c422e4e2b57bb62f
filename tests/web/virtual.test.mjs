// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Virtual time on the page of a real hapnet-web with a real hapnet-lab behind it.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { keepPicture, missing, openPage, patience, programBeside, startBrowser, startWeb }
  from "./browser.mjs";

const skip = missing();
let web = null;
let browser = null;
let page = null;

before(async () => {
  if (skip) return;
  [web, browser] = await Promise.all([startWeb("--virtual"), startBrowser()]);
  page = await openPage(await browser.newContext(), web.address);
});
after(async () => {
  await browser?.close();
  await web?.stop();
});

const pace = () => page.evaluate(() => globalThis.hapnet.model.state.pace);
const paceIs = (state) => page.waitForFunction((wanted) =>
  globalThis.hapnet.model.state.pace?.state === wanted, state, patience);

/** Goes there by the page's own slider; gives what it shows then. */
const seek = async (seconds) => {
  const { length_s: length } = await pace();
  await page.locator("#timeline-range").fill(String(Math.round((1000 * seconds) / length)));
  const near = (value) => Math.abs(value - seconds) < length / 1000;
  await page.waitForFunction(([to, tolerance]) => {
    const { frame, state } = globalThis.hapnet.model;
    return Math.abs(state.pace.at_s - to) < tolerance && Math.abs(frame.at_s - to) < tolerance
      && frame.pairs[0].apart_mm !== null
      && frame.peers.every((peer) => Math.abs(peer.at_ns / 1e9 - 1000 - frame.at_s) < 0.01);
  }, [seconds, length / 1000], patience);
  const shown = await page.evaluate(() => {
    const { frame, state } = globalThis.hapnet.model;
    return { at_s: state.pace.at_s, digest: state.pace.digest,
      cubes: frame.peers.map((peer) => peer.cube), apart_mm: frame.pairs[0].apart_mm };
  });
  assert.ok(near(shown.at_s));
  return shown;
};

test("virtual time shows without a complaint, and says that it is virtual", { skip }, async () => {
  await page.waitForSelector("#charts .plot canvas");
  assert.match(await page.textContent("#mode"), /virtual/);
  await page.waitForSelector("#pace:not([hidden])");
  const others = await page.evaluate(() =>
    globalThis.hapnet.model.frame.emulator.others.map((one) => one.algorithm));
  assert.deepEqual(others, ["dead-reckoning", "sep"]);
  assert.deepEqual(page.complaints, []);
});

test("30 s play in less than 3 s, as fast as it goes", { skip }, async () => {
  const began = performance.now();
  await page.selectOption("#factor", "max");
  await paceIs("ended");
  const seconds = (performance.now() - began) / 1000;
  assert.ok((await pace()).at_s > 30);
  assert.ok(seconds < 3, `${seconds} s`);
});

test("sought twice, a moment has equal numbers", { skip }, async () => {
  const first = await seek(10);
  await seek(4);
  assert.deepEqual(await seek(10), first);
  await keepPicture(page, "virtual");
});

test("what was set is saved as an experiment that repeats it to the bit", { skip }, async () => {
  await seek(12);
  const delay = page.locator('.slider[data-setting="delay"] input[type="number"]').first();
  await delay.fill("80");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() =>
    globalThis.hapnet.model.conditions["up.delay"] === "80ms", undefined, patience);
  await page.click("#play");
  await paceIs("ended");
  const played = await pace();
  assert.equal(played.steps.length, 1);
  await page.click("#save");
  await page.waitForFunction(() => globalThis.hapnet.model.events.some((event) =>
    event.kind === "pace" && event.files?.length === 1), undefined, patience);
  const file = join(web.out, "run-1", "experiment-1.toml");
  assert.match(readFileSync(file, "utf8"), /\[\[at\]\]/);
  const lab = programBeside("hapnet-lab");
  const again = JSON.parse(execFileSync(lab, ["play", file, "--json"], { encoding: "utf8" }));
  assert.equal(again.digest, played.digest);
  const out = mkdtempSync(join(tmpdir(), "hapnet-web-run-"));
  execFileSync(lab, ["run", file, "--out", out], { stdio: "pipe" });
  rmSync(out, { recursive: true, force: true });
});

test("three peers in virtual time have a row of sliders for each link", { skip }, async () => {
  await page.selectOption("#task", "T7");
  await page.selectOption("#peers", "3");
  await page.click("#start");
  await page.waitForFunction(() => globalThis.hapnet.model.peers.length === 3
    && globalThis.hapnet.model.paths.length === 3, undefined, patience);
  const row = page.locator("#sliders tbody tr", { hasText: "A ⇄ C" });
  await row.locator('.slider[data-setting="delay"] input[type="number"]').fill("70");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => {
    const { conditions } = globalThis.hapnet.model;
    return conditions["1-3.delay"] === "70ms" && conditions["3-1.delay"] === "70ms"
      && conditions["1-2.delay"] !== "70ms";
  }, undefined, patience);
  await keepPicture(page, "three");
});
