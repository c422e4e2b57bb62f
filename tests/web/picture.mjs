// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// picture.mjs FILE ANIMATED REPORT: a picture of the live page, 1440 pixels wide, while the copies
// are apart; both worlds as they move, in virtual time so that it is the same every time; and the
// player and Table 1 of a report.

import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { animationOf } from "./animation.mjs";
import { missing, openPage, programBeside, startBrowser, startWeb } from "./browser.mjs";

const reason = missing();
if (reason) {
  console.error(`picture: ${reason}`);
  process.exit(3);
}
const [still, animated, report] = process.argv.slice(2);
const patience = { timeout: 90_000 };
const browser = await startBrowser();

const takeStill = async () => {
  const web = await startWeb();
  const context = await browser.newContext({
    viewport: { width: 1440, height: 900 }, colorScheme: "light",
  });
  const page = await openPage(context, web.address);
  await page.waitForFunction(() => {
    const { model } = globalThis.hapnet;
    const apart = model.frame.pairs[0]?.apart_mm;
    return model.frame.peers[0]?.session?.at_s > 12 && apart > 10 && apart < 25;
  }, undefined, patience);
  await page.screenshot({ path: still });
  await context.close();
  await web.stop();
};

const pictures = 16;
const begin = 10; // s
const apart = 0.15; // s

const takeAnimated = async () => {
  const web = await startWeb("--virtual");
  const context = await browser.newContext({
    viewport: { width: 900, height: 900 }, colorScheme: "light", deviceScaleFactor: 0.6,
  });
  const page = await openPage(context, web.address);
  const ask = (request) => page.evaluate(async (wanted) => {
    const { post } = await import(document.querySelector("script[type=module]").src
      .replace("app.js", "api.js"));
    await post("/api/pace", wanted);
  }, request);
  await ask({ do: "pause" });
  const clip = await page.locator("#worlds").boundingBox();
  const taken = [];
  for (let i = 0; i < pictures; i += 1) {
    const to = begin + i * apart;
    await ask({ do: "seek", to_s: to });
    await page.waitForFunction((time) => {
      const { frame } = globalThis.hapnet.model;
      return Math.abs(frame.at_s - time) < 1e-3 && frame.pairs[0].apart_mm !== null
        && frame.peers.every((peer) => Math.abs(peer.at_ns / 1e9 - 1000 - time) < 2e-3);
    }, to, patience);
    await page.evaluate(() => new Promise((done) => {
      requestAnimationFrame(() => requestAnimationFrame(done));
    }));
    taken.push(await page.screenshot({ clip }));
  }
  writeFileSync(animated, animationOf(taken, 1000 * apart));
  await context.close();
  await web.stop();
};

const takeReport = async () => {
  const folder = mkdtempSync(join(tmpdir(), "hapnet-report-"));
  const lab = (...words) => execFileSync(programBeside("hapnet-lab"), words, { stdio: "pipe" });
  lab("run", "table1", "--quick", "--out", folder);
  lab("report", folder);
  const context = await browser.newContext({
    viewport: { width: 1100, height: 1400 }, colorScheme: "light",
  });
  const page = await context.newPage();
  await page.goto(`file://${join(folder, "report.html")}`);
  await page.waitForFunction(() => globalThis.hapnet && document.body.dataset.view, undefined,
    patience);
  await page.evaluate(() => globalThis.hapnet.player.goTo(540));
  const box = (where) => page.locator(where).boundingBox();
  const [top, table] = [await box("#replay"), await box("#table1")];
  await page.screenshot({
    path: report, fullPage: true,
    clip: { x: 0, y: top.y, width: 1100, height: table.y + table.height - top.y },
  });
  await context.close();
  rmSync(folder, { recursive: true, force: true });
};

await takeStill();
await takeAnimated();
await takeReport();
await browser.close();
