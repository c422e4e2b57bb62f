// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A session that is over, on the page of a real hapnet-web: its records are played and not changed.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { keepPicture, missing, openPage, patience, programBeside, startBrowser, startWeb }
  from "./browser.mjs";

const skip = missing();
const folder = mkdtempSync(join(tmpdir(), "hapnet-records-"));
let lab = null;
let web = null;
let browser = null;
let page = null;

/** The records of 6 s with a delay of 40 ms. */
const record = () => {
  writeFileSync(join(folder, "kept.toml"), `kind = "trajectories"
tasks = "T3"
duration = "6s"
algorithms = ["base"]
record = true
both.delay = "40ms"
`);
  execFileSync(programBeside("hapnet-lab"), ["run", "kept.toml", "--out", "kept"], { cwd: folder });
  return [1, 2].map((peer) => join(folder, `kept/records/base-T3/peer-${peer}.rec`));
};

before(async () => {
  if (skip) return;
  const socket = join(folder, "lab.sock");
  lab = spawn(programBeside("hapnet-lab"),
    ["play", ...record(), "--control", socket, "--pace", "0.1"]);
  await new Promise((resolve, reject) => {
    lab.stdout.on("data", resolve);
    lab.on("exit", (code) => reject(new Error(`hapnet-lab ended with ${code}`)));
  });
  [web, browser] = await Promise.all([startWeb("--lab", socket), startBrowser()]);
  page = await openPage(await browser.newContext(), web.address);
  await page.click("#play"); // which is a pause
  await page.waitForFunction(() =>
    globalThis.hapnet.model.state.pace.state !== "playing", undefined, patience);
});
after(async () => {
  await browser?.close();
  await web?.stop();
  lab?.removeAllListeners("exit");
  lab?.kill("SIGTERM");
  rmSync(folder, { recursive: true, force: true });
});

/** Goes there by the page's own slider; gives what it shows then. */
const seek = async (thousandth) => {
  await page.locator("#timeline-range").fill(String(thousandth));
  await page.waitForFunction((wanted) => {
    const { frame, state } = globalThis.hapnet.model;
    const to = (wanted / 1000) * state.pace.length_s;
    const before = state.pace.length_s - 6; // the session starts
    return Math.abs(frame.at_s - to) < 1e-3 && frame.pairs[0].apart_mm !== null
      && frame.peers.every((peer) => Math.abs(peer.session.at_s + before - to) < 0.01);
  }, thousandth, patience);
  return page.evaluate(() => {
    const { peers, pairs } = globalThis.hapnet.model.frame;
    return { apart: pairs[0].apart_mm, cubes: peers.map((peer) => peer.cube) };
  });
};

test("says that it shows records, and offers no change", { skip }, async () => {
  assert.equal(await page.textContent("#mode"), "from records");
  await page.waitForSelector("#read-only:not([hidden])");
  for (const id of ["save", "wire", "stage", "network-controls"]) {
    assert.equal(await page.locator(`#${id}`).isVisible(), false, id);
  }
  assert.deepEqual(page.complaints, []);
});

test("goes to a moment twice, and shows the same", { skip }, async () => {
  const first = await seek(500);
  await keepPicture(page, "records");
  assert.notDeepEqual(await seek(250), first);
  assert.deepEqual(await seek(500), first);
  assert.ok(first.apart > 0);
});

test("plays to its end, with the delays that the peers measured", { skip }, async () => {
  await page.selectOption("#factor", "1");
  await page.click("#play");
  const last = await page.waitForFunction(() => {
    const { state, fine } = globalThis.hapnet.model;
    // The last frames may come after the news that it has ended.
    return state.pace.state === "ended" && fine.summary("heard_delay_ms:1", 3);
  }, undefined, patience);
  const { mean: delay } = await last.jsonValue();
  assert.ok(Math.abs(delay - 40) < 1, `${delay} ms`);
});
