// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Virtual time on the page of a real hapnet-web with a real hapnet-lab behind it.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";

import { keepPicture, openPage, patience, programBeside } from "./browser.mjs";
import { assertLooks } from "./looks.mjs";
import { openVirtual } from "./virtual.mjs";

let page = null;
const shown = openVirtual((opened) => { page = opened; });
const { skip, until, pace, paceIs } = shown;

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
  const seen = await page.evaluate(() => {
    const { frame, state } = globalThis.hapnet.model;
    return { at_s: state.pace.at_s, digest: state.pace.digest,
      cubes: frame.peers.map((peer) => peer.cube), apart_mm: frame.pairs[0].apart_mm };
  });
  assert.ok(near(seen.at_s));
  return seen;
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

test("a run that has ended says so, whether it counts, and what can be done", { skip }, async () => {
  await until(() => /run 1 has ended/.test(document.getElementById("stage-state").textContent));
  assert.match(await page.textContent("#help-text"),
    /^Run 1 has ended\. It is valid: .* Play it again .* Restart/);
  assert.equal(await page.textContent("#play"), "Play again");
  await assertLooks(page, { figures: null, seen: (view) => keepPicture(page, `over-${view}`) });
  assert.equal(await page.isVisible("#loop"), false, "virtual time repeats by Play again");
  await page.selectOption("#time", "live");
  assert.equal(await page.isVisible("#loop"), true);
  await page.selectOption("#time", "virtual");
  await page.evaluate(() => document.getElementById("stage").classList.remove("changed"));
});

test("a page that comes after the end shows its worlds and figures", { skip }, async () => {
  const late = await openPage(await shown.browser.newContext(), shown.web.address);
  await late.waitForFunction(() =>
    document.getElementById("apart").textContent !== "–", undefined, patience);
  await late.waitForFunction(() => {
    const drawn = [...document.querySelectorAll(".chart")].map((chart) =>
      [chart.querySelector("canvas").width > 300, chart.querySelector(".note").textContent]);
    return drawn.length === 6 && drawn.every(([isDrawn, note]) => isDrawn || note.endsWith("."));
  }, undefined, patience);
  assert.deepEqual(late.complaints, []);
  await late.context().close();
});

test("Play again begins anew, and plays the same", { skip }, async () => {
  const { digest } = await pace();
  await page.selectOption("#factor", "1");
  await page.click("#play");
  await until(() => {
    const { pace: now } = globalThis.hapnet.model.state;
    return now.state === "playing" && now.at_s < 15;
  });
  assert.match(await page.textContent("#stage-state"), /run 1 plays/);
  assert.equal(await page.isVisible("#help"), false);
  await page.selectOption("#factor", "max");
  await paceIs("ended");
  assert.equal((await pace()).digest, digest);
});

test("copies with other algorithms have their names, and the scale is the chosen one's",
  { skip }, async () => {
    let named = 0;
    for (const seconds of [6, 9, 12]) {
      await seek(seconds);
      await page.waitForTimeout(400);
      const [expected, found] = await page.evaluate(() => {
        const { model } = globalThis.hapnet;
        return [[...model.moment.sides.values()].map((side) => {
          const own = side.bodies.values().next().value.at;
          return side.beside.filter(({ at }) =>
            Math.hypot(...at.map((value, axis) => value - own[axis])) > 0.3)
            .map(({ algorithm }) => algorithm);
        }), [...document.querySelectorAll(".view")].map((view) =>
          [...view.querySelectorAll(".name")].map((label) => label.textContent))];
      });
      assert.deepEqual(found, expected);
      named += found.flat().length;
    }
    assert.ok(named > 0);
    const levels = await page.evaluate(() => [".view > .name", "canvas.space"].map((where) =>
      Number(getComputedStyle(document.querySelector(where)).zIndex)));
    assert.ok(levels[0] > levels[1], "no cube hides a name");
    await assertLooks(page, { figures: null, seen: (view) => keepPicture(page, `named-${view}`) });
    assert.match(await page.textContent("#others-legend"), /dead-reckoning\s*sep$/);
    const reach = await page.evaluate(async () => {
      const { reachOf } = await import(document.querySelector("script[type=module]").src
        .replace("app.js", "chartpanel.js"));
      const plot = { span: 2, robust: true };
      const most = (values) => ({ most: values });
      const own = Array.from({ length: 100 }, (_, i) => i / 10);
      const calm = [{ hidden: false }, { hidden: false, beside: true }];
      return [
        reachOf(plot, calm, [most(own), most([3, 300, 4])]), // what is beside does not choose
        reachOf(plot, calm, [most([...own, 900]), most([1])]), // nor does one peak
        reachOf({ span: 2 }, calm, [most([...own, 900]), most([1])]), // unless it matters
        reachOf(plot, [{ hidden: true }, calm[1]], [most(own), most([3, 30, 30])]),
      ];
    });
    assert.ok(reach[0] >= 9.9 && reach[0] <= 15, `${reach[0]}`);
    assert.ok(reach[1] >= 9.7 && reach[1] <= 15, `${reach[1]}`);
    assert.deepEqual(reach.slice(2), [900, 30]);
  });

test("a story is marked until the network is changed", { skip }, async () => {
  const mark = () => page.getAttribute('#stories [data-story="paper-160"]', "aria-pressed");
  assert.equal(await mark(), "true");
  await page.locator('.slider[data-setting="delay"] input[type="number"]').first().fill("70");
  await page.keyboard.press("Enter");
  await until(() => globalThis.hapnet.model.conditions["up.delay"] === "70ms");
  await until(() => document.querySelector('#stories [aria-pressed="true"]') === null);
  assert.match(await page.textContent("#story-look"), /no longer that of the story/);
  await page.click("#reset");
  await until(() => document.querySelector('#stories [aria-pressed="true"]') !== null);
});

test("the page says path of nothing but the network", { skip }, async () => {
  const words = await page.evaluate(() =>
    `${document.querySelector("main").textContent} ${document.getElementById("guide").textContent}`);
  assert.ok(words.includes("P1"));
  assert.doesNotMatch(words, /\bpaths?\b/);
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
  await until(() => globalThis.hapnet.model.conditions["up.delay"] === "80ms");
  await page.click("#play");
  await paceIs("ended");
  const played = await pace();
  assert.equal(played.steps.at(-1).settings["up.delay"], "80ms");
  await page.click("#save");
  await page.waitForFunction(() => globalThis.hapnet.model.events.some((event) =>
    event.kind === "pace" && event.files?.length === 1), undefined, patience);
  const file = join(shown.web.out, "run-1", "experiment-1.toml");
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
