// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The check of looks finds what is wrong with a page, and nothing on a page that is fine.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { missing, startBrowser } from "./browser.mjs";
import { assertLooks, faultsOf } from "./looks.mjs";

const skip = missing();
let browser = null;
before(async () => { if (!skip) browser = await startBrowser(); });
after(async () => { await browser?.close(); });

const figure = { id: "f", x: { label: "delay", unit: "ms" }, y: { label: "apart", unit: "mm" } };

/** A page of these elements, which carries these figures. */
const pageOf = async (body, figures = [figure]) => {
  const page = await browser.newPage({ viewport: { width: 390, height: 844 } });
  await page.setContent(`<!DOCTYPE html><meta name="color-scheme" content="light dark">
    <style>html { background: Canvas } p, figure { margin: 0 } svg { fill: currentColor }</style>
    <body><script type="application/json" id="hapnet-data">${JSON.stringify({ figures })}</script>
    ${body}`);
  return page;
};
const drawn = (words = "<text x='20' y='20'>0</text>") => `<figure data-figure="f">
  <div class="plot"><svg width="200" height="100">${words}</svg></div>
  <p class="source">Data: <a href="t.csv">t.csv</a></p></figure>`;

test("nothing is wrong with a plain page that has a figure", { skip }, async () => {
  const page = await pageOf(`<h1>Delay</h1>${drawn()}<button>Play</button>`);
  await assertLooks(page);
  await page.close();
});

test("each fault is found and named", { skip }, async () => {
  const faults = {
    "scrolls sideways": [`<p style="width:500px">wide</p>${drawn()}`],
    "is cut": [`<p style="width:90px;overflow:auto;white-space:pre">${"long ".repeat(9)}</p>`
      + drawn()],
    "sticks out": [drawn("<text x='-20' y='20'>outside</text>")],
    "lies over": [drawn("<text x='9' y='20'>one</text><text x='12' y='20'>two</text>")],
    "px high": [`<p style="font-size:11px">small</p>${drawn()}`],
    "contrast of": [`<p style="color:#888;background:#999">faint</p>${drawn()}`],
    "its cells": [`<table><thead><tr><th style="text-align:left">mm<tbody><tr>
      <td style="text-align:right">5</table>${drawn()}`],
    "no unit of x": [drawn(), [{ ...figure, x: { label: "delay", unit: "" } }]],
    "no label of y": [drawn(), [{ ...figure, y: { label: "", unit: "mm" } }]],
    "no source": [drawn().replace(/<p.*<\/p>/s, "")],
    "not drawn": [drawn().replace(/<svg.*<\/svg>/s, "")],
    "first figure ends": [`<p style="height:800px">text</p>${drawn()}`],
    "no name": [`${drawn()}<button></button>`],
    "the keyboard does not reach": [`${drawn()}<button tabindex="-1">Play</button>`],
  };
  for (const [words, parts] of Object.entries(faults)) {
    const page = await pageOf(...parts);
    const found = await faultsOf(page);
    assert.ok(found.some((fault) => fault.includes(words)), `${words}: ${found.join("; ")}`);
    await page.close();
  }
});

test("what the browser complains of is a fault", { skip }, async () => {
  const page = await pageOf(drawn());
  page.complaints = ["404"];
  assert.deepEqual(await faultsOf(page), ["the browser says: 404"]);
  await page.close();
});
