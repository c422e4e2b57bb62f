// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Reports that hapnet-lab writes, opened from disk in a real browser that may load nothing else.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, renameSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { keepPicture, missing, patience, programBeside, startBrowser } from "./browser.mjs";
import { assertLooks } from "./looks.mjs";

const skip = missing();
const folder = skip ? null : mkdtempSync(join(tmpdir(), "hapnet-report-"));
const experiments = skip ? null : join(folder, "experiments");
let browser = null;
let page = null;

const lab = (...words) => execFileSync(programBeside("hapnet-lab"), words, { stdio: "pipe" });

/** Two peers that play P1 for 3 s over the emulator: all three leave their files in the folder. */
const record = async (where) => {
  const emulator = spawn(programBeside("hapnet-emulator"),
    ["--listen-a", "127.0.0.1:0", "--listen-b", "127.0.0.1:0", "--delay", "40ms", "--loss", "5%",
      "--stats", join(where, "run.json"), "--fates", join(where, "run.fates")]);
  const ended = new Promise((resolve) => { emulator.on("exit", resolve); });
  const ports = await new Promise((resolve, reject) => {
    emulator.on("exit", (code) => reject(new Error(`hapnet-emulator ended with ${code}`)));
    emulator.stdout.once("data", (text) => resolve(/a=(\S+) b=(\S+)/.exec(text).slice(1)));
  });
  const peers = ports.map((remote, i) => spawn(programBeside("hapnet-peer"), [
    "--id", String(i + 1), "--remote", remote, "--task", "P1", "--duration", "3s",
    "--record", join(where, `${i + 1}.rec`),
  ], { stdio: "ignore" }));
  await Promise.all(peers.map((peer) => new Promise((resolve) => { peer.on("exit", resolve); })));
  emulator.kill("SIGTERM");
  await ended;
};

/** The report in the folder, in a page that counts complaints and whatever it asks for. */
const openReport = async (where, prepare = async () => {}) => {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 } });
  const one = await context.newPage();
  one.setDefaultTimeout(patience.timeout);
  Object.assign(one, { complaints: [], asked: [] });
  one.on("console", (message) => {
    if (message.type() === "error") one.complaints.push(message.text());
  });
  one.on("pageerror", (error) => one.complaints.push(error.message));
  one.on("request", (request) => one.asked.push(request.url().slice(0, 60)));
  await prepare(one);
  await one.goto(`file://${join(where, "report.html")}`);
  await one.waitForFunction(() => globalThis.hapnet && document.body.dataset.view, undefined,
    patience);
  return one;
};

before(async () => {
  if (skip) return;
  lab("run", "table1", "--quick", "--out", join(experiments, "table1"));
  lab("run", "fig7", "--quick", "--out", join(experiments, "fig7"));
  lab("report", experiments);
  browser = await startBrowser();
  page = await openReport(experiments);
});
after(async () => {
  await browser?.close();
  if (folder) rmSync(folder, { recursive: true, force: true });
});

test("opens from disk, asks for nothing, complains of nothing, plays in space", { skip },
  async () => {
    assert.deepEqual(page.complaints, []);
    const others = page.asked.filter((address) => !/^(file|data|blob):/.test(address));
    assert.deepEqual(others, []);
    assert.equal(page.asked.filter((address) => address.startsWith("file:")).length, 1);
    assert.equal(await page.evaluate(() => document.body.dataset.view), "3-D");
    await page.waitForSelector("figure[data-figure] .plot svg");
  });

/** Where the plot of a figure is, in pixels of the window. */
const plotOf = async (one, name) => {
  const plot = one.locator(`figure[data-figure="${name}"] .plot`);
  await plot.scrollIntoViewIfNeeded();
  return plot.boundingBox();
};
const rangeOf = (one, name) =>
  one.evaluate((figure) => globalThis.hapnet.figures[figure].zoom.range, name);

test("pointing at a figure tells the values of its curves there", { skip }, async () => {
  const { x, y, width, height } = await plotOf(page, "fig7-base");
  await page.mouse.move(x + width / 2, y + height / 2);
  const words = (part) => page.textContent(`figure[data-figure="fig7-base"] ${part}`);
  await page.waitForFunction(() =>
    document.querySelector('figure[data-figure="fig7-base"] .pointed').textContent !== "");
  const at = Number((await words(".pointed")).replace("at ", ""));
  const [from, to] = await rangeOf(page, "fig7-base");
  assert.ok(at > from + 0.3 * (to - from) && at < from + 0.7 * (to - from), `${at} s`);
  const said = Number(await words(".legend button:first-child .figure"));
  const { points } = await page.evaluate(() =>
    globalThis.hapnet.figures["fig7-base"].data.series[0]);
  const near = points.reduce((a, b) => (Math.abs(b[0] - at) < Math.abs(a[0] - at) ? b : a));
  assert.ok(Math.abs(near[1] - said) <= 0.06 * Math.max(1, Math.abs(said)), `${near} and ${said}`);
});

test("dragging across a figure zooms all that show the same time", { skip }, async () => {
  const [low, high] = await rangeOf(page, "fig7-base");
  const { x, y, width, height } = await plotOf(page, "fig7-base");
  await page.mouse.move(x + 0.4 * width, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + 0.6 * width, y + height / 2, { steps: 4 });
  await page.mouse.up();
  const [from, to] = await rangeOf(page, "fig7-base");
  assert.ok(to - from < 0.35 * (high - low) && from > low && to < high, `${from} to ${to}`);
  assert.deepEqual(await rangeOf(page, "fig7-difference-base"), [from, to]);
  await page.locator("#fig7 .zoom-buttons button", { hasText: "all" }).click();
  // But for the last bits of what is computed.
  const showsAll = async (figure) => {
    const [first, last] = await rangeOf(page, figure);
    assert.ok(Math.abs(first - low) < 1e-9 && Math.abs(last - high) < 1e-9, `${first} to ${last}`);
  };
  await showsAll("fig7-difference-base");
  await page.locator('figure[data-figure="fig7-base"] .plot').focus();
  await page.keyboard.press("+");
  const [nearFrom, nearTo] = await rangeOf(page, "fig7-base");
  assert.ok(Math.abs(nearTo - nearFrom - (high - low) / 2) < 1e-6);
  await page.keyboard.press("0");
  await showsAll("fig7-base");
});

test("the legend hides a curve and shows it again", { skip }, async () => {
  const button = page.locator('figure[data-figure="fig7-base"] .legend button').first();
  const hidden = () => page.evaluate(() => [...globalThis.hapnet.figures["fig7-base"].hidden]);
  await button.click();
  assert.equal(await button.getAttribute("aria-pressed"), "false");
  assert.deepEqual(await hidden(), ["cube at A"]);
  await button.click();
  assert.deepEqual(await hidden(), []);
});

test("a figure is saved as SVG in light colours, and has its numbers as a table", { skip },
  async () => {
    const figure = page.locator('figure[data-figure="table1-mean"]');
    await page.emulateMedia({ colorScheme: "dark" });
    const [download] = await Promise.all([
      page.waitForEvent("download"), figure.locator(".save").click(),
    ]);
    await page.emulateMedia({ colorScheme: "light" });
    assert.equal(download.suggestedFilename(), "table1-mean.svg");
    const svg = readFileSync(await download.path(), "utf8");
    assert.match(svg, /^<svg .*>Mean distance of the two copies</s);
    assert.match(svg, /fill="#0072b2"/);
    assert.doesNotMatch(svg, /var\(/);
    await figure.locator("details summary").click();
    await figure.locator("tbody tr").first().waitFor(); // it is filled after it has opened
    const rows = await figure.locator("tbody tr").allTextContents();
    assert.equal(rows.length, 6, rows.join());
    assert.match(rows[0], /^base.*paper: [0-9.]+ mm/);
  });

test("a bar tells what it is; each figure leads to the rows behind it", { skip }, async () => {
  const figure = page.locator('figure[data-figure^="table1-"]').first();
  await figure.locator(".part").first().hover();
  assert.match(await figure.locator(".pointed").textContent(), /paper: [0-9.]+ mm/);
  const links = await page.evaluate(() => [...document.querySelectorAll("figure[data-figure]")]
    .map((one) => one.querySelector(".source a")?.getAttribute("href")));
  assert.ok(links.length > 10);
  for (const link of links) {
    assert.ok(link, "a figure without a link");
    assert.ok(existsSync(join(experiments, link)), link);
  }
});

const player = (name) =>
  page.evaluate((key) => globalThis.hapnet.player[key], name);

test("the player goes on by itself, and goes where one wants", { skip }, async () => {
  await page.locator(".player").scrollIntoViewIfNeeded();
  const begin = await player("at");
  await page.click(".player .play");
  await page.waitForFunction((at) => globalThis.hapnet.player.at > at + 20, begin, patience);
  assert.equal(await player("isPlaying"), true);
  await keepPicture(page, "report-player");
  await page.click(".player .play");
  assert.equal(await player("isPlaying"), false);
  const clock = () => page.textContent(".player .clock");
  const stopped = await clock();
  await page.locator(".player").focus();
  await page.keyboard.press("Shift+ArrowRight");
  await page.waitForFunction((was) =>
    document.querySelector(".player .clock").textContent !== was, stopped, patience);
  const strip = await page.locator(".player .strip .plot").boundingBox();
  await page.mouse.click(strip.x + 0.5 * strip.width, strip.y + strip.height / 2);
  const at = await player("at");
  const count = await page.evaluate(() => globalThis.hapnet.player.replay.count);
  assert.ok(at > 0.4 * count && at < 0.6 * count, `${at} of ${count}`);
  assert.ok(!/let go/.test(await clock()));
  await page.locator(".player").focus();
  await page.keyboard.press("End");
  await page.waitForFunction(() => /: the hands let go, the replay ends$/
    .test(document.querySelector(".player .clock").textContent), undefined, patience);
});

test("dragging one world turns them all", { skip }, async () => {
  const yaw = () => page.evaluate(() => globalThis.hapnet.player.orbit.yaw);
  const before = await yaw();
  const view = await page.locator(".player .view").first().boundingBox();
  await page.mouse.move(view.x + 100, view.y + 60);
  await page.mouse.down();
  await page.mouse.move(view.x + 160, view.y + 60, { steps: 3 });
  await page.mouse.up();
  assert.ok(Math.abs((await yaw()) - before) > 0.2);
  assert.equal(await page.locator(".player .pane").count(), 2);
  assert.deepEqual(page.complaints, []);
});

test("another algorithm can be chosen, and its copies are told apart", { skip }, async () => {
  const names = await page.locator(".player .algorithm option").allTextContents();
  assert.ok(names.length > 1, names.join());
  await page.selectOption(".player .algorithm", names.at(-1));
  assert.equal(await page.evaluate(() => globalThis.hapnet.player.replay.algorithm), names.at(-1));
  await page.waitForFunction(() => /copies apart: [0-9.]+ mm/.test(
    document.querySelector(".player .apart").textContent), undefined, patience);
});

test("fits 390 pixels, and every control has a name", { skip }, async () => {
  await page.setViewportSize({ width: 390, height: 800 });
  await page.waitForFunction(() => document.documentElement.scrollWidth <= 390, undefined,
    patience);
  await keepPicture(page, "report-narrow");
  await page.setViewportSize({ width: 1280, height: 900 });
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll("button, input, select")]
      .filter((one) => !one.labels?.length && !one.ariaLabel && !one.textContent.trim())
      .map((one) => one.outerHTML));
  assert.deepEqual(nameless, []);
});

const withoutWebGl = (one) => one.addInitScript(() => {
  HTMLCanvasElement.prototype.getContext = new Proxy(HTMLCanvasElement.prototype.getContext, {
    apply: (get, canvas, [kind]) => (kind === "2d" ? get.call(canvas, kind) : null),
  });
});
const withoutLibraries = (one) => one.addInitScript(() => {
  globalThis.DecompressionStream = undefined; // as in an older browser
});

test("without WebGL, and without libraries, it shows a still picture and words", { skip }, async () => {
  for (const [prepare, name] of [[withoutWebGl, "webgl"], [withoutLibraries, "libraries"]]) {
    const still = await openReport(experiments, prepare);
    assert.equal(await still.evaluate(() => document.body.dataset.view), "still");
    await still.click(".player .play");
    await still.waitForFunction(() => globalThis.hapnet.player.at > 1, undefined, patience);
    const { x, y, width, height } = await plotOf(still, "fig7-base");
    await still.mouse.move(x + width / 2, y + height / 2);
    await still.waitForFunction(() =>
      document.querySelector('figure[data-figure="fig7-base"] .pointed').textContent !== "");
    assert.deepEqual(still.complaints, []);
    await keepPicture(still, `report-without-${name}`);
    await still.context().close();
  }
});

test("the report of two records does the same, alone in another folder", { skip }, async () => {
  await record(folder);
  lab("report", join(folder, "1.rec"), join(folder, "2.rec"));
  const rows = readFileSync(join(folder, "figures/session-P1-apart.csv"), "utf8").split("\n");
  assert.equal(rows[0], "curve,time_from_the_start_s,x_a_x_b_mm");
  const alone = mkdtempSync(join(folder, "alone-"));
  renameSync(join(folder, "report.html"), join(alone, "report.html"));
  const session = await openReport(alone);
  assert.equal(await session.evaluate(() => document.body.dataset.view), "3-D");
  const names = await session.evaluate(() => Object.keys(globalThis.hapnet.figures));
  assert.deepEqual(names.sort(), ["apart", "cubes", "delay", "delays", "forces", "lateness", "loss"]
    .map((name) => `session-P1-${name}`));
  const most = await session.evaluate(() => Math.max(
    ...globalThis.hapnet.figures["session-P1-apart"].data.series[0].points.map(([, y]) => y)));
  assert.ok(most > 1, `${most} mm apart at 40 ms`);
  await assertLooks(session);
  await keepPicture(session, "report-session");
  await session.context().close();
});

test("the page of a run of the emulator draws its figures, alone in another folder", { skip },
  async () => {
    const alone = mkdtempSync(join(folder, "run-"));
    execFileSync(programBeside("hapnet-emulator"),
      ["report", join(folder, "run.json"), "--out", join(alone, "report.html")], { stdio: "pipe" });
    const run = await openReport(alone);
    await run.waitForFunction(() => [...document.querySelectorAll("figure[data-figure]")]
      .every((one) => one.querySelector(".plot > svg path, .plot > svg rect")), undefined, patience);
    const { names, drawn } = await run.evaluate(() => ({
      names: Object.keys(globalThis.hapnet.figures),
      drawn: [...document.querySelectorAll("figure[data-figure]")]
        .filter((one) => one.querySelector(".plot > svg path, .plot > svg rect"))
        .map((one) => one.dataset.figure),
    }));
    assert.deepEqual(drawn.sort(), names.sort());
    for (const name of ["delay-over-time", "delay-up", "lateness-down", "loss-runs-up",
      "losses-down"]) {
      assert.ok(names.includes(name), name);
    }
    assert.match(await run.textContent("#tests table"), /up: loss/);
    assert.deepEqual(run.complaints, []);
    await assertLooks(run);
    await keepPicture(run, "report-run");
    await run.context().close();
  });
