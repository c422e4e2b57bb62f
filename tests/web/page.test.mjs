// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The page of a real hapnet-web in a real browser. Judged by its state and its elements, never by
// pixels or pictures a second.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

import { lowContrasts } from "./contrast.mjs";
import { keepPicture, missing, openPage, patience, startBrowser, startWeb } from "./browser.mjs";

const skip = missing();
let web = null;
let browser = null;
let page = null;

before(async () => {
  if (skip) return;
  [web, browser] = await Promise.all([startWeb(), startBrowser()]);
  page = await openPage(await browser.newContext(), web.address);
  if (page.complaints.length > 0) return; // the first test says so
  await page.selectOption("#preset", "ideal"); // what a reset goes back to
  await page.click("#start");
  await page.waitForFunction(() => {
    const { stage } = globalThis.hapnet.model.state;
    return stage.state === "running" && stage.choice.preset === "ideal";
  }, undefined, patience);
});
after(async () => {
  await browser?.close();
  await web?.stop();
});

/** Waits until the mean of 2 s of a running session lies between these, mm. */
const waitForApart = (least, most) => page.waitForFunction(([low, high]) => {
  const { model } = globalThis.hapnet;
  const at = model.frame.peers[0]?.session?.at_s ?? 0;
  const moves = at > 3 && at < 26; // not with hands off
  const mean = moves ? model.fine.summary("apart_mm:1-2", 2)?.mean : undefined;
  return mean >= low && mean < high;
}, [least, most], patience);

const rowsOf = (one) => one.evaluate(() => {
  const { fine } = globalThis.hapnet.model;
  return { oldest: fine.oldest, length: fine.length };
});

test("loads in space, with charts, without a complaint", { skip }, async () => {
  await page.waitForSelector("#charts .plot canvas");
  assert.equal(await page.evaluate(() => document.body.dataset.view), "3-D");
  assert.deepEqual(page.complaints, []);
});

test("a chart is saved as SVG, in light colours", { skip }, async () => {
  await waitForApart(0, 100); // there is a curve
  const [download] = await Promise.all([
    page.waitForEvent("download"), page.locator('[data-chart="apart"] .save').click(),
  ]);
  assert.equal(download.suggestedFilename(), "hapnet-apart.svg");
  const svg = readFileSync(await download.path(), "utf8");
  assert.match(svg, /^<svg .*<path [^>]*stroke="#0b62a8".*>Copies apart, /s);
  assert.doesNotMatch(svg, /var\(/);
  assert.deepEqual(page.complaints, []);
});

test("a delay set by keyboard moves the copies apart, reset joins them", { skip }, async () => {
  await page.click("#reset");
  await waitForApart(0, 1);
  const delay = page.locator('.slider[data-setting="delay"] input[type="number"]').first();
  await delay.focus();
  await page.keyboard.press("Control+A");
  await page.keyboard.type("160");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() =>
    globalThis.hapnet.model.conditions["up.delay"] === "160ms", undefined, patience);
  await waitForApart(8, 20);
  await keepPicture(page, "apart");
  await page.click("#reset");
  await waitForApart(0, 1);
});

test("a preset holds, and what is set for 2 s ends by itself", { skip }, async () => {
  await page.locator("#presets button", { hasText: /^lan$/ }).click();
  await page.waitForFunction(() =>
    globalThis.hapnet.model.conditions["up.delay"] !== undefined, undefined, patience);
  await page.click("#reset");
  await page.fill("#lasts-s", "2");
  await page.check("#lasts");
  const loss = page.locator('.slider[data-setting="loss"] input[type="number"]').first();
  await loss.fill("9");
  await page.keyboard.press("Enter");
  const lossIs = (value) => page.waitForFunction((wanted) =>
    globalThis.hapnet.model.conditions["up.loss"] === wanted, value, patience);
  await lossIs("9%");
  await lossIs(undefined);
  await page.uncheck("#lasts");
});

test("a trap saves the last seconds, which tshark opens", { skip }, async () => {
  const delay = page.locator('.slider[data-setting="delay"] input[type="number"]').first();
  await page.fill("#trap-when", "apart_mm>5");
  await page.click("#arm");
  await delay.fill("160");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => globalThis.hapnet.model.events.some((event) =>
    event.kind === "keep" && event.files.length === 3), undefined, patience);
  await page.click("#reset");
  await page.click("#arm");
  await page.locator("#files summary").click();
  await keepPicture(page, "trap");
  const kept = join(web.out, "kept");
  const names = readdirSync(kept).sort();
  assert.deepEqual(names, ["trap-1-peer-1.rec", "trap-1-peer-2.rec", "trap-1.pcapng"]);
  const files = await page.evaluate(async () => {
    const { get } = await import(document.querySelector("script[type=module]").src
      .replace("app.js", "api.js"));
    return (await get("/api/files")).files.map((file) => file.name);
  });
  for (const name of names) assert.ok(files.includes(`kept/${name}`), name);
  if (!existsSync("/usr/bin/tshark")) return;
  const packets = execFileSync("/usr/bin/tshark", ["-r", join(kept, "trap-1.pcapng"), "-T",
    "fields", "-e", "frame.time_relative"], { encoding: "utf8" }).trim().split("\n");
  // 10 s of 1000 a second, each way, that come and leave; a busy machine sends fewer.
  assert.ok(packets.length > 20_000 && packets.length < 41_000, `${packets.length} packets`);
  const seconds = Number(packets.at(-1));
  assert.ok(seconds > 9 && seconds < 10.5, `${seconds} s`);
});

test("the demo stops and starts", { skip }, async () => {
  const stageIs = (state) => page.waitForFunction((wanted) =>
    globalThis.hapnet.model.state.stage.state === wanted, state, patience);
  await page.click("#stop");
  await stageIs("stopped");
  assert.equal(await page.textContent("#start"), "Start");
  await page.waitForSelector("#help:not([hidden])");
  await page.click("#start");
  await stageIs("running");
  await waitForApart(0, 100);
});

test("the number and the sentence tell one mean", { skip }, async () => {
  const [number, sentence] = await page.evaluate(() =>
    ["apart", "sentence"].map((id) => document.getElementById(id).textContent));
  const said = /(?:is|within) ([0-9.]+) mm/.exec(sentence);
  assert.ok(said, sentence);
  assert.ok(Math.abs(Number(said[1]) - Math.max(0.1, Number(number))) < 0.051, sentence + number);
});

test("a second tab follows, and has the history", { skip }, async () => {
  const second = await openPage(page.context(), web.address);
  const [first, other] = [await rowsOf(page), await rowsOf(second)];
  assert.ok(other.oldest < first.oldest + 5, `${other.oldest} s, ${first.oldest} s`);
  await page.locator('.slider[data-setting="loss"] input[type="number"]').first().fill("7");
  await page.keyboard.press("Enter");
  await second.waitForFunction(() =>
    document.querySelector('.slider[data-setting="loss"] input[type="number"]').value === "7",
  undefined, patience);
  await page.click("#reset");
  await second.reload();
  await second.waitForFunction(() => globalThis.hapnet?.model.fine.length > 100);
  assert.ok((await rowsOf(second)).oldest < other.oldest + 5, "a reload keeps the history");
  await second.close();
});

test("a page too busy to show its token in time tries again", { skip }, async () => {
  const busy = await openPage(await browser.newContext(), web.address, (one) =>
    one.addInitScript(() => {
      globalThis.opened = 0;
      globalThis.WebSocket = class extends WebSocket {
        constructor(...all) {
          super(...all);
          this.addEventListener("open", () => {
            globalThis.opened += 1;
            const end = performance.now() + (globalThis.opened === 1 ? 2000 : 0);
            while (performance.now() < end); // before the page's own listener
          });
        }
      };
    }));
  assert.ok(await busy.evaluate(() => globalThis.opened) > 1);
  await busy.context().close();
});

test("without WebGL, and without modules, it shows a still picture and words", { skip }, async () => {
  for (const pattern of [null, /three\./]) {
    const still = await openPage(await browser.newContext(), web.address, async (one) => {
      if (pattern) await one.route(pattern, (route) => route.abort());
      else {
        await one.addInitScript(() => {
          HTMLCanvasElement.prototype.getContext = new Proxy(
            HTMLCanvasElement.prototype.getContext,
            { apply: (get, canvas, [kind]) => (kind === "2d" ? get.call(canvas, kind) : null) },
          );
        });
      }
    });
    assert.equal(await still.evaluate(() => document.body.dataset.view), "still");
    await still.waitForSelector(".view > svg rect");
    await still.waitForFunction(() =>
      / at -?[0-9.]+, .* mm/.test(document.querySelector(".view .in-words").textContent));
    await still.waitForSelector(".plot canvas");
    await still.context().close();
  }
});

test("fits 390 and 1440 pixels; the header takes two lines at 1280", { skip }, async () => {
  for (const width of [390, 1280, 1440]) {
    await page.setViewportSize({ width, height: 900 });
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= width, `${wide} px of ${width}`);
  }
  await page.setViewportSize({ width: 1280, height: 900 });
  const high = await page.evaluate(() => document.querySelector(".bar").offsetHeight);
  assert.ok(high < 95, `${high} px`);
});

test("every control has a name, and the keys reach them in order", { skip }, async () => {
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll("button, input, select, textarea")]
      .filter((one) => !one.labels?.length && !one.ariaLabel && !one.textContent.trim())
      .map((one) => one.outerHTML));
  assert.deepEqual(nameless, []);
  assert.equal(await page.evaluate(() =>
    document.querySelectorAll('[tabindex]:not([tabindex="0"])').length), 0);
  await page.reload(); // the keys begin at the top
  await page.waitForFunction(() => globalThis.hapnet?.model.frame && document.body.dataset.view);
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.className), "skip");
});

for (const scheme of ["light", "dark"]) {
  test(`text stands out from its ground, ${scheme}`, { skip }, async () => {
    await page.emulateMedia({ colorScheme: scheme });
    await page.evaluate(() => {
      for (const one of document.querySelectorAll("details")) one.open = true;
    });
    const { texts, low } = await lowContrasts(page);
    assert.ok(texts > 100, `${texts} texts`);
    assert.deepEqual(low, []);
    await keepPicture(page, scheme);
  });
}

test("the check of contrasts finds what does not stand out", { skip }, async () => {
  await page.evaluate(() => {
    const pale = document.createElement("p");
    pale.textContent = "pale";
    pale.style.cssText = "color: #8a8a8a; background: rgb(255 255 255 / 50%)";
    document.querySelector("main").append(pale);
  });
  const { low } = await lowContrasts(page);
  assert.deepEqual(low.map((one) => one.text), ["pale"]);
});

test("what the server does not offer is not there", { skip }, async () => {
  const [state, shown] = await page.evaluate(() => {
    const { keep, pace } = globalThis.hapnet.model.state;
    const seen = (id) => document.getElementById(id).offsetParent !== null;
    return [[keep.available, pace !== null], [seen("keep"), seen("pace")]];
  });
  assert.deepEqual(shown, state);
});
