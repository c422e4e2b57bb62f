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
import { assertLooks } from "./looks.mjs";
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
  await page.click("#stop"); // then a preset is what the next session begins with
  await page.waitForFunction(() =>
    globalThis.hapnet.model.state.stage.state === "stopped", undefined, patience);
  await page.locator("#presets button", { hasText: /^ideal$/ }).click(); // reset goes back to it
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
    page.waitForEvent("download"), page.locator('[data-chart="apart"] .save', { hasText: "SVG" }).click(),
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

test("repeat is ticked and unticked without a new start", { skip }, async () => {
  const run = () => page.evaluate(() => globalThis.hapnet.model.state.stage.run);
  const loops = (wanted) => page.waitForFunction((value) =>
    globalThis.hapnet.model.state.stage.loop === value, wanted, patience);
  const before = await run();
  await page.uncheck("#loop");
  await loops(false);
  await page.check("#loop");
  await loops(true);
  assert.equal(await page.evaluate(() => globalThis.hapnet.model.state.stage.state), "running");
  assert.equal(await run(), before);
});

test("after the end the page says whether the run counts, and keeps what it showed", { skip },
  async () => {
    const before = await page.evaluate(() => globalThis.hapnet.model.state.stage.run);
    await page.evaluate(async () => {
      const { post } = await import(document.querySelector("script[type=module]").src
        .replace("app.js", "api.js"));
      await post("/api/stage", { do: "restart", seconds: 6, loop: false });
    });
    await page.waitForFunction((run) => {
      const { stage } = globalThis.hapnet.model.state;
      return stage.run > run && ["stopped", "failed"].includes(stage.state);
    }, before, patience);
    const { state, says, run, last } = await page.evaluate(() =>
      globalThis.hapnet.model.state.stage);
    assert.equal(state, "stopped", says);
    assert.equal(last.run, run);
    await page.waitForFunction(() => /^Run \d+ has ended\. It is (valid|not valid) as a measurement: /
      .test(document.getElementById("help-text").textContent), undefined, patience);
    assert.match(await page.textContent("#help-text"), /Start plays again/);
    assert.match(await page.textContent("#stage-state"), /^run \d+ has ended$/);
    assert.equal(await page.locator(".pane").count(), 2, "the worlds stay");
    assert.notEqual(await page.textContent("#apart"), "–");
    await page.waitForFunction(() => [...document.querySelectorAll(".pane .state")]
      .map((state) => state.textContent).join() === "ended,ended", undefined, patience);
    assert.equal(await page.isChecked("#loop"), false);
    assert.equal(await page.textContent("#network-error"), "");
    assert.equal(await page.locator(".chart:visible").count(), 6, "and so do the charts");
    await assertLooks(page, { figures: null, seen: (view) => keepPicture(page, `ended-${view}`) });
    await page.evaluate(async () => {
      const { post } = await import(document.querySelector("script[type=module]").src
        .replace("app.js", "api.js"));
      await post("/api/stage", { do: "start", seconds: 30, loop: true });
    });
    await waitForApart(0, 100);
  });

test("in 100 moments, the number is the difference of the positions shown", { skip }, async () => {
  await page.locator('.slider[data-setting="delay"] input[type="number"]').first().fill("160");
  await page.keyboard.press("Enter");
  await waitForApart(8, 20);
  const found = await page.evaluate(async () => {
    const text = (where) => document.querySelector(where).textContent;
    const tenths = (words) => Math.round(10 * Number.parseFloat(words));
    const { model } = globalThis.hapnet;
    const moments = [];
    while (moments.length < 100) {
      await new Promise((done) => { setTimeout(done, 20 + 100 * Math.random()); });
      // One in three looks back, at a moment of the last minute.
      const { newest, oldest } = model.fine;
      const back = oldest + Math.random() * (newest - oldest);
      model.lookAt(moments.length % 3 === 0 ? back : null);
      await new Promise((done) => { setTimeout(done, 600 * Math.random()); });
      if (text("#apart") === "–") continue;
      const cubes = [...document.querySelectorAll(".pane .readout > span:nth-child(2) .figure")];
      moments.push({
        apart: tenths(text("#apart")), cubes: cubes.map((one) => tenths(one.textContent)),
        said: [.../= (-?[0-9.]+) mm, B's at (-?[0-9.]+) mm/.exec(text("#sentence"))].slice(1)
          .map(tenths),
        pair: text("#pair"),
      });
    }
    model.lookAt(null);
    return moments;
  });
  for (const { apart, cubes, said, pair } of found) {
    assert.equal(apart, Math.abs(cubes[0] - cubes[1]));
    assert.deepEqual(said, cubes);
    assert.equal(pair, "mm between A and B");
  }
  assert.ok(new Set(found.map(({ apart }) => apart)).size > 20, "the number changes");
  await page.click("#reset");
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

test("a build without three.js asks for none and names none", { skip }, async () => {
  const asked = [];
  const still = await openPage(await browser.newContext(), web.address, async (one) => {
    one.on("request", (request) => asked.push(request.url()));
    await one.addInitScript(() => {
      document.addEventListener("readystatechange", () => { // before any module runs
        document.getElementById("three").setAttribute("href", "");
      }, { once: true });
    });
  });
  assert.equal(await still.evaluate(() => document.body.dataset.view), "still");
  assert.deepEqual(still.complaints, []);
  assert.deepEqual(asked.filter((url) => /three|scene3d/.test(url)), []);
  assert.equal(await still.locator("#credit").isVisible(), false);
  await still.context().close();
});

test("a share above 100 % is refused in words, and changes nothing", { skip }, async () => {
  await page.click("#reset");
  const loss = page.locator('.slider[data-setting="loss"] input[type="number"]').first();
  await loss.fill("150");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#effect.error");
  assert.match(await page.textContent("#effect"), /loss.* cannot be 150 %: enter 0 to 100 %\./);
  assert.equal(await loss.inputValue(), "0");
  assert.equal(await page.evaluate(() => globalThis.hapnet.model.conditions["up.loss"]), undefined);
});

test("'same in both directions' holds only while they are the same", { skip }, async () => {
  const linked = page.locator("#linked");
  const set = (settings) => page.evaluate(async (wanted) => {
    const { post } = await import(document.querySelector("script[type=module]").src
      .replace("app.js", "api.js"));
    await post("/api/emulator", { command: "set", settings: wanted });
  }, settings);
  assert.equal(await linked.isChecked(), true);
  await set({ "up.delay": "20ms", "up.loss": "3%" });
  await page.waitForFunction(() => !document.getElementById("linked").checked, undefined, patience);
  await linked.check();
  await page.waitForFunction(() => {
    const { conditions } = globalThis.hapnet.model;
    return conditions["down.delay"] === "20ms" && conditions["down.loss"] === "3%"
      && document.getElementById("linked").checked;
  }, undefined, patience);
  await page.click("#reset");
});

/** Plays that story; resolves once its network holds. */
const tell = async (title, preset, key, value) => {
  const before = await page.evaluate(() => globalThis.hapnet.model.state.stage.run);
  await page.locator("#stories button", { hasText: title }).click();
  await page.waitForFunction(([run, name, setting, wanted]) => {
    const { stage, emulator } = globalThis.hapnet.model.state;
    return stage.run > run && stage.state === "running" && stage.choice.preset === name
      && emulator.attached && emulator.conditions?.[setting] === wanted;
  }, [before, preset, key, value], patience);
};

test("a story starts what it tells of, and says where to look", { skip }, async () => {
  await tell("97 % loss with remote-proxy", "loss-97", "up.loss", "97%");
  await page.waitForFunction(() =>
    document.getElementById("story-look").textContent.startsWith("Watch"), undefined, patience);
  assert.match(await page.textContent("#algorithm-says"), /^remote-proxy: .*\.$/);
  assert.equal(await page.getAttribute('[data-preset="loss-97"]', "aria-pressed"), "true");
});

test("a link carries the settings and never the token", { skip }, async () => {
  await tell("97 % loss with remote-proxy", "loss-97", "up.loss", "97%");
  await page.locator('.slider[data-setting="delay"] input[type="number"]').first().fill("33");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() =>
    globalThis.hapnet.model.conditions["up.delay"] === "33ms", undefined, patience);
  await page.waitForFunction(() =>
    document.querySelector('#presets [aria-pressed="true"]') === null, undefined, patience);
  await page.click("#copy-link");
  await page.waitForSelector("#link-shown:not([hidden])");
  const link = await page.inputValue("#link-text");
  const token = new URLSearchParams(new URL(web.address).hash.slice(1)).get("t");
  assert.ok(token.length > 20 && !link.includes(token), link);
  assert.doesNotMatch(link, /[#&]t=/);
  await tell("The paper's 160 ms", "paper-delay-160", "up.delay", "160ms");
  const other = await openPage(await browser.newContext(), `${link}&t=${token}`);
  assert.doesNotMatch(other.url(), /[#&]t=/);
  await other.click("#follow-link");
  await other.waitForFunction(() => {
    const { model } = globalThis.hapnet;
    return model.state.stage.choice.algorithm === "remote-proxy"
      && model.conditions["up.delay"] === "33ms" && model.conditions["down.loss"] === "97%";
  }, undefined, patience);
  assert.deepEqual(other.complaints, []);
  await other.context().close();
  const without = await (await browser.newContext()).newPage();
  await without.goto(link);
  await without.waitForFunction(() =>
    /does not know/.test(document.getElementById("connection").textContent), undefined, patience);
  await without.context().close();
});

test("the help opens by its key, explains, and closes by Escape", { skip }, async () => {
  await page.locator("#open-guide").focus();
  await page.keyboard.press("?");
  await page.waitForSelector("#guide[open]");
  assert.match(await page.textContent("#guide"), /remote-proxy.*/s);
  assert.equal(await page.evaluate(() =>
    document.getElementById("guide").contains(document.activeElement)), true);
  await page.keyboard.press("Escape");
  await page.waitForSelector("#guide:not([open])", { state: "attached" });
  assert.equal(await page.evaluate(() => document.activeElement.id), "open-guide");
});

test("a chart is saved as CSV: a head, and a line for each moment", { skip }, async () => {
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.locator('[data-chart="apart"] .save', { hasText: "CSV" }).click(),
  ]);
  assert.equal(download.suggestedFilename(), "hapnet-apart.csv");
  const [head, ...lines] = readFileSync(await download.path(), "utf8").trim().split("\n");
  assert.equal(head, '"at, s","A–B, mm","A–B least, mm","A–B most, mm"');
  assert.ok(lines.length > 50, `${lines.length} lines`);
  for (const line of lines) {
    assert.match(line, /^-?[0-9]+\.[0-9]{3}(,([0-9.e-]+)?){3}$/);
    for (const cell of line.split(",").slice(1)) // of six digits at most
      assert.ok(cell.replace(/e.*|^-?0\.0*|[-.]/g, "").length <= 6, cell);
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

test("nothing is cut, small, faint or nameless, in any of its looks", { skip }, async () => {
  await page.evaluate(() => scrollTo(0, 0));
  const folds = [];
  await assertLooks(page, {
    figures: null, // the worlds have one canvas together
    seen: async (view) => {
      await keepPicture(page, view);
      folds.push(...await page.evaluate(() => {
        const { bottom } = document.querySelector(".pane").getBoundingClientRect();
        return bottom <= innerHeight ? [] : [`${bottom} px of ${innerHeight}`];
      }));
    },
  });
  assert.deepEqual(folds, [], "the first world is above the fold");
  const { figures } = JSON.parse(await page.textContent("#hapnet-data"));
  assert.equal(figures.length, 6);
  for (const { id, title, x, y, source, series } of figures) {
    const shown = page.locator(`[data-figure="${id}"]`);
    assert.ok(title && x.label && x.unit && y.label && y.unit && series.length > 0, id);
    assert.equal(await shown.locator(".source").textContent(), `Source: ${source}.`);
    assert.match(await shown.locator("figcaption").textContent(), new RegExp(`${y.unit}, over`));
  }
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
