// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// picture.mjs LIVE ANIMATED REPORT SESSION RUN: a picture of the live page, 1440 pixels wide, while
// the copies are apart; both worlds as they move, in virtual time so that it is the same every
// time; Table 1 and the player of a report; and the pages of a session of two peers over the
// emulator and of the emulator's run.

import { execFileSync, spawn } from "node:child_process";
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
const [still, animated, report, session, run] = process.argv.slice(2);
const patience = { timeout: 90_000 };
const browser = await startBrowser();

const takeStill = async () => {
  const web = await startWeb();
  const context = await browser.newContext({
    viewport: { width: 1440, height: 900 }, colorScheme: "light",
  });
  const page = await openPage(context, web.address);
  await page.waitForFunction(() => {
    const apart = Number(document.getElementById("apart").textContent);
    return globalThis.hapnet.model.frame.peers[0]?.session?.at_s > 12 && apart > 15 && apart < 30
      && document.getElementById("timing").classList.contains("met");
  }, undefined, patience);
  await page.screenshot({ path: still });
  await context.close();
  await web.stop();
};

const pictures = 16;
const begin = 10; // s
const apart = 0.15; // s

/** Ends when the worlds have stood still for ten frames: they are not drawn in each. */
const whenDrawn = () => new Promise((done) => {
  const shown = () => document.getElementById("worlds").innerText;
  let [last, same] = [shown(), 0];
  const look = () => {
    const now = shown();
    same = now === last ? same + 1 : 0;
    last = now;
    if (same === 10) done();
    else requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
});

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
    await page.evaluate(whenDrawn);
    taken.push(await page.screenshot({ clip }));
  }
  writeFileSync(animated, animationOf(taken, 1000 * apart));
  await context.close();
  await web.stop();
};

const pageWidth = 1100;

/** A page of results, wide enough for two figures beside each other. */
const openResults = async (file) => {
  const context = await browser.newContext({
    viewport: { width: pageWidth, height: 1400 }, colorScheme: "light",
  });
  const page = await context.newPage();
  await page.goto(`file://${file}`);
  await page.waitForFunction(() => globalThis.hapnet && document.body.dataset.view, undefined,
    patience);
  return page;
};

/** Takes what lies between the top of one element and the bottom of another. */
const takePart = async (page, path, from, to) => {
  const box = (where) => page.locator(where).boundingBox();
  const [first, last] = [await box(from), await box(to)];
  const top = Math.max(0, first.y - 16); // letters stand out of their line
  const height = last.y + last.height - top;
  await page.screenshot({ path, fullPage: true, clip: { x: 0, y: top, width: pageWidth, height } });
  await page.context().close();
};

const lab = (...words) => execFileSync(programBeside("hapnet-lab"), words, { stdio: "pipe" });

const takeReport = async () => {
  const folder = mkdtempSync(join(tmpdir(), "hapnet-report-"));
  lab("run", "table1", "--quick", "--out", folder);
  lab("report", folder);
  const page = await openResults(join(folder, "report.html"));
  await page.evaluate(() => {
    document.getElementById("tasks").remove();
    globalThis.hapnet.player.goTo(540);
  });
  await takePart(page, report, "#table1", "#replay");
  rmSync(folder, { recursive: true, force: true });
};

const network = `name = "Wi-Fi that fails for half a second"
both.delay = "20ms"
both.jitter = { law = "gamma", mean = "3ms", sd = "6ms", correlation_time = "20ms" }
[[at]]
time = "7s"
up.delay = "80ms"
[[at]]
time = "11s"
both.loss = "100%"
[[at]]
time = "11.5s"
both.loss = "2%"
`;

/** The records of two peers over the emulator, with its statistics and fates, in the folder. */
const playOverEmulator = async (folder) => {
  const at = (name) => join(folder, name);
  writeFileSync(at("network.toml"), network);
  const emulator = spawn(programBeside("hapnet-emulator"),
    ["--listen-a", "127.0.0.1:0", "--listen-b", "127.0.0.1:0", "--profile", at("network.toml"),
      "--stats", at("run.json"), "--fates", at("run.fates")]);
  const ended = new Promise((resolve) => { emulator.on("exit", resolve); });
  const remotes = await new Promise((resolve, reject) => {
    emulator.on("exit", (code) => reject(new Error(`hapnet-emulator ended with ${code}`)));
    emulator.stdout.once("data", (text) => resolve(/a=(\S+) b=(\S+)/.exec(text).slice(1)));
  });
  const peers = remotes.map((remote, i) => spawn(programBeside("hapnet-peer"), [
    "--id", String(i + 1), "--remote", remote, "--task", "T3", "--duration", "16s",
    "--record", at(`peer-${i + 1}.rec`),
  ], { stdio: "ignore" }));
  await Promise.all(peers.map((peer) => new Promise((resolve) => { peer.on("exit", resolve); })));
  emulator.kill("SIGTERM");
  await ended;
};

const takeSession = async () => {
  const folder = mkdtempSync(join(tmpdir(), "hapnet-session-"));
  await playOverEmulator(folder);
  lab("report", join(folder, "peer-1.rec"), join(folder, "peer-2.rec"));
  await takePart(await openResults(join(folder, "report.html")), session, "header",
    'figure[data-figure$="-lateness"]');
  execFileSync(programBeside("hapnet-emulator"),
    ["report", join(folder, "run.json"), "--out", join(folder, "run.html")], { stdio: "pipe" });
  await takePart(await openResults(join(folder, "run.html")), run, "header", "#figures .panels");
  rmSync(folder, { recursive: true, force: true });
};

await takeStill();
await takeAnimated();
await takeReport();
await takeSession();
await browser.close();
