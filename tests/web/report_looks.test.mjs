// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// How the pages of results look: each kind of experiment, wide and narrow, light and dark.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { keepPicture, missing, patience, programBeside, startBrowser } from "./browser.mjs";
import { assertLooks } from "./looks.mjs";

const skip = missing();
const folder = skip ? null : mkdtempSync(join(tmpdir(), "hapnet-looks-"));
let browser = null;

before(async () => { if (!skip) browser = await startBrowser(); });
after(async () => {
  await browser?.close();
  if (folder) rmSync(folder, { recursive: true, force: true });
});

const lab = (...words) => execFileSync(programBeside("hapnet-lab"), words, { stdio: "pipe" });
const set = (...settings) => settings.flatMap((setting) => ["--set", setting]);

/** Opens the page that is in this folder. */
const openReport = async (where) => {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  const page = await context.newPage();
  page.complaints = [];
  page.on("console", (message) => {
    if (message.type() === "error") page.complaints.push(message.text());
  });
  page.on("pageerror", (error) => page.complaints.push(error.message));
  await page.goto(`file://${join(where, "report.html")}`);
  await page.waitForFunction(() => globalThis.hapnet && document.body.dataset.view, undefined,
    patience);
  return page;
};

/** Plays an experiment, and opens its page as one does who has just made it. */
const pageOf = async (name, experiment, ...more) => {
  const out = join(folder, name);
  lab("run", experiment, ...more, "--out", out);
  lab("report", out);
  return openReport(out);
};

const looksWell = (page, name) =>
  assertLooks(page, { seen: (view) => keepPicture(page, `report-${name}-${view}`) });
const figuresOf = (page) => page.evaluate(() => globalThis.hapnet.data.figures);
const textOf = (page, where) => page.locator(where).innerText();
/** All that the page says but for the explanations of names, which may speak of the paper. */
const resultsOf = async (page) =>
  (await page.locator("header, section:not(#names)").allInnerTexts()).join("\n");

const short = ["duration=\"6s\"", "algorithms=[\"base\", \"dead-reckoning\"]"];

test("claims: a row for each, with its interval and its verdict, all of it seen", { skip },
  async () => {
    const page = await pageOf("claims", "beat", "--quick", "--seeds", "2", ...set("duration=\"6s\""));
    await looksWell(page, "claims");
    assert.match(await textOf(page, ".lead"), /^Simulated hands played tasks P1, T1, .* 2 seeds\./);
    const claims = page.locator("#beyond table").first();
    assert.equal(await claims.locator("tbody tr").count(), 15);
    const [width, right] = await claims.evaluate((table) =>
      [document.documentElement.clientWidth, table.getBoundingClientRect().right]);
    assert.ok(right <= width, `the table ends at ${right} of ${width} px`);
    const heads = await claims.locator("thead th").allTextContents();
    assert.deepEqual(heads.slice(0, 4), ["claim", "measured", "accepted", "verdict"]);
    const cells = await claims.locator("tbody tr").first().locator("td").allTextContents();
    assert.match(cells[0], /^100 ms: [0-9.]+ % usable/);
    assert.match(cells[2], /^first look: (inside|outside|undecided|not measured)$/);
    assert.match(await textOf(page, "#beyond"),
      /Played with 2 of 200 seeds and 6 of 30 s: a first look, not a verdict\./);
    const rows = (await figuresOf(page)).flatMap(({ series }) => series.flatMap(({ dots }) => dots));
    assert.ok(rows.length >= 20 && rows.every(({ accepted }) => accepted), `${rows.length} numbers`);
    await page.context().close();
  });

test("an axis: each measure against it, a line for each algorithm, with its interval", { skip },
  async () => {
    const page = await pageOf("axis", "table1", "--seeds", "3",
      ...set(...short, "tasks=[\"T2\"]", "axis.key=both.delay", "axis.values=[\"20ms\", \"0.1s\"]"));
    await looksWell(page, "axis");
    assert.equal(await textOf(page, "h1"), "Results by delay of the path");
    assert.match(await textOf(page, ".lead"), /with delay of the path varied \(20 ms and 0.1 s\)/);
    const figure = (await figuresOf(page)).find(({ id }) => id === "axis-both-delay-T2-mean-mm");
    assert.deepEqual(figure.series.map(({ name }) => name), ["base", "dead-reckoning"]);
    for (const { points, band } of figure.series) {
      assert.deepEqual(points.map(([x]) => x), [20, 100], "in one unit");
      points.forEach(([, y], i) => assert.ok(band[i][1] <= y && y <= band[i][2], `${y} in its band`));
    }
    assert.ok(!/paper/i.test(await resultsOf(page)), "it says nothing of the paper");
    await page.context().close();
  });

test("an axis of words: bars with their intervals", { skip }, async () => {
  const page = await pageOf("words", "table1", "--seeds", "2",
    ...set(...short, "tasks=[\"T2\"]", "axis.key=hands", "axis.values=[\"relaxed\", \"firm\"]"));
  await looksWell(page, "words");
  const figure = (await figuresOf(page)).find(({ id }) => id === "axis-hands-T2-mean-mm");
  assert.deepEqual(figure.x.categories, ["relaxed", "firm"]);
  assert.ok(figure.series[0].bars.every(({ low, value, high }) => low <= value && value <= high));
  await page.context().close();
});

test("limits: the fitted curve, its points, and the interval where it crosses one half", { skip },
  async () => {
    const page = await pageOf("limits", "fig6a", "--quick", "--seeds", "4",
      ...set("tasks=[\"T2\"]", "algorithms=[\"base\"]"));
    await looksWell(page, "limits");
    const figure = (await figuresOf(page))[0];
    assert.equal(figure.id, "failing-delay");
    const [{ points, scatter, crossing }] = figure.series;
    assert.ok(points.length > 50 && scatter.length > 2);
    const half = points.find(([, y]) => y >= 50)[0];
    assert.ok(crossing.low <= half && half <= crossing.high, `${half} in ${JSON.stringify(crossing)}`);
    await page.context().close();
  });

test("a map of networks says which of them each algorithm bears", { skip }, async () => {
  const page = await pageOf("map", "plane", "--quick", ...set(short[1], "tasks=[\"T2\"]"));
  await looksWell(page, "map");
  const maps = (await figuresOf(page)).filter(({ kind }) => kind === "heat-map");
  assert.equal(maps.length, 4);
  // A finger that taps a field is told its numbers, which stay when it has left.
  const finger = await page.context().newCDPSession(page);
  await finger.send("Emulation.setTouchEmulationEnabled", { enabled: true });
  const figure = page.locator(`figure[data-figure="${maps[0].id}"]`);
  const field = figure.locator(".part").first();
  await field.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await field.boundingBox();
  const at = { x: x + width / 2, y: y + height / 2 };
  await finger.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [at] });
  await finger.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  await page.waitForTimeout(300);
  assert.equal(await figure.locator(".pointed").textContent(), await field.locator("title")
    .textContent());
  await page.context().close();
});

const own = `title = "Three in a stack"
kind = "table1"
seeds = 2
algorithms = ["base"]
tasks = ["T2", "T9"]
duration = "8s"
both.delay = "80ms"
`;

test("one's own experiment: its own scene and bodies, and nothing of the paper", { skip },
  async () => {
    const file = join(folder, "own.toml");
    writeFileSync(file, own);
    const page = await pageOf("own", file);
    await looksWell(page, "own");
    const player = (what) => page.evaluate((words) => {
      const { replay } = globalThis.hapnet.player;
      return words === "names" ? replay.scene.bodies.map(({ name }) => name)
        : replay.sides.map(({ name, bodies }) => [name, bodies.length, Boolean(bodies[0].qw)]);
    }, what);
    await page.selectOption(".player .task", "T9");
    assert.deepEqual(await player("names"), ["first", "second", "third"]);
    assert.deepEqual(await player("sides"), [["A", 3, true], ["B", 3, true]]);
    await page.selectOption(".player .task", "T2");
    assert.deepEqual(await player("sides"), [["A", 1, false], ["B", 1, false]]);
    assert.ok(!/paper|predicted|calibrated/i.test(await resultsOf(page)));
    assert.equal(await page.locator(".missed").count(), 0);
    await page.context().close();
  });

const kept = `kind = "trajectories"
tasks = "T3"
duration = "12s"
algorithms = ["base"]
record = true
up.delay = "60ms"
up.loss = "10%"
down.delay = "20ms"
down.jitter = { law = "uniform", half_width = "5ms" }
`;

/** Delay and loss of the page, by the direction: the values of its curves. */
const valuesOf = async (page, end) => {
  const { series } = (await figuresOf(page)).find(({ id }) => id.endsWith(end));
  return Object.fromEntries(series.map(({ name, points }) => [name, points.map(([, y]) => y)]));
};

test("a recorded session: both directions of its network, its clocks, its records and commands",
  { skip }, async () => {
    const file = join(folder, "kept.toml");
    writeFileSync(file, kept);
    const out = join(folder, "kept");
    lab("run", file, "--out", out);
    const records = join(out, "records/base-T3");
    lab("report", ...[1, 2].map((peer) => join(records, `peer-${peer}.rec`)));
    const page = await openReport(records);
    await looksWell(page, "session");
    const lead = "Two simulated hands, A (peer 1) and B (peer 2), played task T3 for 12 s with the "
      + "algorithm base, in virtual time. Valid: ";
    assert.equal((await textOf(page, ".lead")).slice(0, lead.length), lead);
    const delay = await valuesOf(page, "-delay");
    assert.ok(delay["A to B"].every((ms) => Math.abs(ms - 60) < 0.1), String(delay["A to B"]));
    // In order, a message a millisecond takes at most 22 ms with the chance 0.7 * 0.8 * 0.9 = 0.5.
    assert.ok(delay["B to A"].every((ms) => Math.abs(ms - 22) < 1), String(delay["B to A"]));
    const loss = await valuesOf(page, "-loss");
    const mean = loss["A to B"].reduce((sum, one) => sum + one, 0) / loss["A to B"].length;
    // 10 % of 12 000 messages: the standard deviation is 0.27 %.
    assert.ok(Math.abs(mean - 10) < 1.4, `${mean} % of the messages are lost`);
    assert.ok(loss["B to A"].every((percent) => percent === 0));
    assert.match(await textOf(page, "#sessions"), /Both peers played in virtual time/);
    const sources = await page.locator("figure .source a").evaluateAll((links) =>
      [...new Set(links.map((link) => link.getAttribute("href")))]);
    assert.ok(["peer-1.rec", "peer-2.rec"].every((record) => sources.includes(record)), `${sources}`);
    assert.match(await textOf(page, "#repeat"), /hapnet-lab analyse peer-1.rec peer-2.rec/);
    await page.context().close();
  });
