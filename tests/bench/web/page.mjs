// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// What the live page costs, and how soon it shows what happens, in a Chromium that draws with the
// processor. Options: --quick (a minute instead of ten), --json FILE.

import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { cpus, loadavg, platform, release } from "node:os";
import { parseArgs } from "node:util";

import { missing, openPage, startBrowser, startWeb } from "../../web/browser.mjs";
import { rowOf } from "./rows.mjs";

const { values: chosen } = parseArgs({
  options: { quick: { type: "boolean", default: false }, json: { type: "string" } },
});
const [watched, settled, changes, steps] = chosen.quick ? [15, 5, 20, 3] : [300, 130, 200, 20];
const ticksPerSecond = 100; // of /proc/PID/stat, on Linux
const sleep = (seconds) => new Promise((resolve) => { setTimeout(resolve, 1000 * seconds); });

const quantile = (list, share) => {
  const sorted = [...list].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
};

/** Fields of /proc/PID/stat after the name: state, parent, ... */
const statOf = (pid) => {
  try {
    return readFileSync(`/proc/${pid}/stat`, "utf8").replace(/^.*\) /s, "").split(" ");
  } catch {
    return null; // it has ended
  }
};
const secondsOf = (pid) => {
  const stat = statOf(pid);
  return stat ? (Number(stat[11]) + Number(stat[12])) / ticksPerSecond : 0;
};
const megabytesOf = (pid) =>
  Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, "utf8"))[1]) / 1024;

/** Every process of the browser: the descendants of this one, but for `other` and its children. */
const browserProcesses = (other) => {
  const all = readdirSync("/proc").filter((name) => /^\d+$/.test(name))
    .map((name) => [Number(name), Number(statOf(name)?.[1])]);
  const below = (parent) => all.filter(([pid, up]) => up === parent && pid !== other)
    .flatMap(([pid]) => [pid, ...below(pid)]);
  return below(process.pid);
};

/** How far the page's clock is behind CLOCK_MONOTONIC, ms: the quickest of many questions. */
const clockOffset = async (page) => {
  let best = { round: Infinity, offset: 0 };
  for (let i = 0; i < 100; i += 1) {
    const before = Number(process.hrtime.bigint()) / 1e6;
    const there = await page.evaluate(() => performance.now());
    const after = Number(process.hrtime.bigint()) / 1e6;
    const round = after - before;
    if (round < best.round) best = { round, offset: (before + after) / 2 - there };
  }
  return best;
};

/** Ages of frames in ms when the worlds are painted, and how many pictures a second. */
const agesOnScreen = async (page, seconds) => {
  const { offset, round } = await clockOffset(page);
  const { ages, frames } = await page.evaluate(([length, behind]) => new Promise((resolve) => {
    const { model, worlds } = globalThis.hapnet;
    const found = [];
    const first = worlds.painted;
    let last = first;
    const end = performance.now() + 1000 * length;
    // After the page's own turn, which has painted the newest frame or nothing.
    const turn = () => {
      const at = model.frame?.peers?.[0]?.at_ns;
      if (at !== undefined && worlds.painted !== last) {
        last = worlds.painted;
        // After the browser has taken over what this turn painted.
        const channel = new MessageChannel();
        channel.port1.onmessage = () => found.push(performance.now() + behind - at / 1e6);
        channel.port2.postMessage(0);
      }
      if (performance.now() < end) requestAnimationFrame(turn);
      else resolve({ ages: found, frames: (worlds.painted - first) / length });
    };
    requestAnimationFrame(turn);
  }), [seconds, offset]);
  return { ages, frames, uncertain: round / 2 };
};

/** Milliseconds from a change until the server has answered, again and again. */
const replies = (page, count) => page.evaluate(async (times) => {
  const { post } = await import(document.querySelector("script[type=module]").src
    .replace("app.js", "api.js"));
  const found = [];
  for (let i = 0; i < times; i += 1) {
    const settings = { "both.delay": `${i % 2}ms` };
    const begin = performance.now();
    await post("/api/emulator", { command: "set", settings });
    found.push(performance.now() - begin);
    await new Promise((resolve) => { setTimeout(resolve, 40); });
  }
  return found;
}, count);

/** Milliseconds, less the delay itself, from a change until the chart's legend shows it. */
const shownAfter = (page, count) => page.evaluate(async (times) => {
  const { post } = await import(document.querySelector("script[type=module]").src
    .replace("app.js", "api.js"));
  const value = () => Number(document.querySelector(
    '[data-chart="delay"] .legend button:first-child .figure').textContent);
  const until = (test) => new Promise((resolve) => {
    const turn = () => (test() ? resolve() : requestAnimationFrame(turn));
    turn();
  });
  const set = (ms) => post("/api/emulator", { command: "set", settings: { "up.delay": `${ms}ms` } });
  const found = [];
  for (let i = 0; i < times; i += 1) {
    await set(0);
    await until(() => value() < 5);
    const begin = performance.now();
    await set(50);
    await until(() => value() > 25);
    found.push(performance.now() - begin - 50);
  }
  await set(0);
  return found;
}, count);

const heap = (page) => page.evaluate(() => {
  globalThis.gc();
  return performance.memory.usedJSHeapSize / 1e6;
});

/** What the server and the browser take of one core while somebody watches; the heap's growth. */
const costs = async (page, web) => {
  await sleep(settled); // the page keeps two minutes
  const before = await heap(page);
  const children = browserProcesses(web.pid);
  const took = () => children.reduce((sum, pid) => sum + secondsOf(pid), 0);
  const [server, browser, begin] = [secondsOf(web.pid), took(), performance.now()];
  await sleep(watched);
  const seconds = (performance.now() - begin) / 1000;
  return {
    server: (100 * (secondsOf(web.pid) - server)) / seconds,
    browser: (100 * (took() - browser)) / seconds,
    memory: megabytesOf(web.pid),
    growth: (await heap(page)) - before,
  };
};

const measure = async (page, web) => {
  const rows = [];
  const row = (metric, unit, value, target) =>
    rows.push({ case: "live page, 2 peers, 1 page", metric, unit, value, target,
      met: target === null ? null : value <= target });
  const paint = await page.evaluate(() =>
    performance.getEntriesByName("first-contentful-paint")[0]?.startTime);
  row("first paint", "ms", paint, 1000);
  const answered = await replies(page, changes);
  row("slider to reply, p99", "ms", quantile(answered, 0.99), 20);
  row("slider to chart less the delay, median", "ms",
    quantile(await shownAfter(page, steps), 0.5), 100);
  const { ages, frames, uncertain } = await agesOnScreen(page, chosen.quick ? 5 : 30);
  row(`age of a frame as painted, p95, ±${uncertain.toFixed(1)}`, "ms", quantile(ages, 0.95), 60);
  row("frames painted in a second", "1/s", frames, null);
  const { server, browser, memory, growth } = await costs(page, web);
  row("hapnet-web of one core", "%", server, 3);
  row("hapnet-web, resident", "MB", memory, 60);
  row("Chromium of one core, drawn by the processor", "%", browser, null);
  row(`heap's growth in ${watched} s`, "MB", growth, 5);
  return rows;
};

const reason = missing();
if (reason) {
  console.error(`bench: ${reason}`);
  process.exit(3);
}
const [web, browser] = await Promise.all([
  startWeb(), startBrowser(["--js-flags=--expose-gc", "--enable-precise-memory-info"]),
]);
try {
  const page = await openPage(await browser.newContext(), web.address);
  await page.click("#reset");
  const rows = await measure(page, web);
  for (const { metric, unit, value, target, met } of rows) {
    const judged = met === null ? "" : `at most ${target}  ${met ? "met" : "MISSED"}`;
    console.log(`${metric.padEnd(48)} ${value.toFixed(1).padStart(7)} ${unit.padEnd(4)} ${judged}`);
  }
  const host = {
    machine: `${platform()} ${release()}`, processor: cpus()[0].model, processors: cpus().length,
    load: loadavg()[0], browser: browser.version(),
  };
  console.log(JSON.stringify(host));
  if (chosen.json) {
    const written = rows.map((row) => rowOf({ ...row, subject: "hapnet-web" }));
    writeFileSync(chosen.json, `${JSON.stringify({ host, rows: written }, null, 1)}\n`);
  }
} finally {
  await browser.close();
  await web.stop();
}
