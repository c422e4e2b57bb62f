// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// What is wrong with the looks of a page, as sentences: elements that are cut, small or faint text,
// figures without axes or sources, a first figure below the fold, controls without a name.

import assert from "node:assert/strict";

import { lowContrasts } from "./contrast.mjs";

const sizes = [{ width: 1280, height: 800 }, { width: 390, height: 844 }];
const schemes = ["light", "dark"];
const leastText = 12; // pixels
const round = 1; // pixels: what browsers round away

/** Elements that stick out of the page, or whose content is wider than they are. */
const cutElements = (page) => page.evaluate((slack) => {
  const isSeen = (element) => element.checkVisibility({ opacityProperty: true,
    visibilityProperty: true }) && element.getBoundingClientRect().width > 2;
  const nameOf = (element) => {
    const { tagName, textContent } = element;
    const style = element.getAttribute("class");
    return `${tagName.toLowerCase()}${style ? `.${style}` : ""} "${textContent.trim().slice(0, 30)}"`;
  };
  const faults = [];
  const { scrollWidth, clientWidth } = document.documentElement;
  if (scrollWidth > clientWidth + slack)
    faults.push(`the page scrolls sideways: ${scrollWidth} of ${clientWidth} px`);
  for (const element of document.querySelectorAll("body *")) {
    if (!isSeen(element)) continue;
    const { left, right } = element.getBoundingClientRect();
    const isDrawn = element.ownerSVGElement?.contains(element) ?? false;
    if (!isDrawn && (left < -slack || right > clientWidth + slack))
      faults.push(`${nameOf(element)} reaches from ${Math.round(left)} to ${Math.round(right)} px`);
    const style = getComputedStyle(element);
    const hidesOverflow = style.overflowX !== "visible" && !isDrawn
      && !element.matches("svg, canvas, input, select, textarea");
    if (hidesOverflow && element.scrollWidth > element.clientWidth + slack) {
      faults.push(`${nameOf(element)} is cut: ${element.scrollWidth} px in `
        + `${element.clientWidth} px`);
    }
  }
  for (const drawing of document.querySelectorAll("svg")) {
    const frame = drawing.getBoundingClientRect();
    if (!isSeen(drawing) || drawing.ownerSVGElement) continue;
    const boxes = [...drawing.querySelectorAll("text")].filter((text) => text.textContent !== "")
      .map((text) => ({ words: text.textContent, box: text.getBoundingClientRect() }));
    for (const { words, box } of boxes) {
      if (box.left < frame.left - slack || box.right > frame.right + slack
        || box.top < frame.top - slack || box.bottom > frame.bottom + slack)
        faults.push(`"${words}" sticks out of its figure`);
    }
    boxes.forEach(({ words, box }, i) => boxes.slice(i + 1).forEach((other) => {
      const across = Math.min(box.right, other.box.right) - Math.max(box.left, other.box.left);
      const down = Math.min(box.bottom, other.box.bottom) - Math.max(box.top, other.box.top);
      if (across > 2 && down > 5) faults.push(`"${words}" lies over "${other.words}"`);
    }));
  }
  return faults;
}, round);

const smallTexts = (page) => page.evaluate((least) => {
  const isSeen = (element) => element.checkVisibility({ opacityProperty: true,
    visibilityProperty: true }) && element.getBoundingClientRect().width > 2;
  const hasWords = (element) => [...element.childNodes]
    .some((node) => node.nodeType === Node.TEXT_NODE && node.data.trim() !== "");
  return [...document.querySelectorAll("body *")].filter((element) =>
    isSeen(element) && hasWords(element)
    && parseFloat(getComputedStyle(element).fontSize) < least - 0.01)
    .map((element) => `"${element.textContent.trim().slice(0, 30)}" is `
      + `${getComputedStyle(element).fontSize} high`);
}, leastText);

/** Heads of tables that do not stand as the cells below them do. */
const strayHeads = (page) => page.evaluate(() => {
  const sideOf = (cell) => (["left", "start"].includes(getComputedStyle(cell).textAlign)
    ? "left" : getComputedStyle(cell).textAlign);
  return [...document.querySelectorAll("table")].flatMap((table) => {
    const [heads, cells] = [table.tHead?.rows[0]?.cells ?? [], table.tBodies[0]?.rows[0]?.cells];
    if (!cells || !table.tHead.checkVisibility()) return [];
    return [...heads].flatMap((head, i) => (cells[i] && head.textContent.trim() !== ""
      && sideOf(head) !== sideOf(cells[i])
      ? [`head "${head.textContent}" stands ${sideOf(head)}, its cells ${sideOf(cells[i])}`] : []));
  });
});

/** Figures without axis, unit or source, or without a drawing; `data` are those the page carries. */
const poorFigures = (page, selector) => page.evaluate((figures) => {
  const carried = document.getElementById("hapnet-data");
  const known = new Map((carried ? JSON.parse(carried.textContent).figures : [])
    .map((figure) => [figure.id, figure]));
  const faults = [];
  for (const element of document.querySelectorAll(figures)) {
    const { figure: id } = element.dataset;
    const fault = (words) => faults.push(`figure ${id ?? element.id}: ${words}`);
    if (element.checkVisibility() && !element.querySelector("svg, canvas")) fault("not drawn");
    const data = known.get(id);
    if (!data) continue;
    for (const [name, axis] of [["x", data.x], ["y", data.y]]) {
      if (!axis.label) fault(`no label of ${name}`);
      if (!axis.unit && !axis.categories) fault(`no unit of ${name}`);
    }
    if (!element.querySelector(".source")?.textContent.trim()) fault("no source");
  }
  return faults;
}, selector);

const firstFigure = (page, selector) => page.evaluate((figures) => {
  const first = document.querySelector(figures);
  if (!first) return ["no figure"];
  const { bottom } = (first.querySelector(".plot, svg, canvas") ?? first).getBoundingClientRect();
  const end = Math.round(bottom + scrollY);
  return end <= innerHeight ? [] : [`the first figure ends at ${end} px of ${innerHeight}`];
}, selector);

/** Controls that a screen reader cannot name, or that the keyboard does not reach. */
const poorControls = (page) => page.evaluate(() => {
  const controls = [...document.querySelectorAll("button, input, select, textarea, a[href], summary")]
    .filter((one) => one.checkVisibility());
  const namesOf = (one) => [one.ariaLabel, one.title, one.textContent,
    ...[...(one.labels ?? [])].map((label) => label.textContent),
    ...(one.getAttribute("aria-labelledby") ?? "").split(" ")
      .map((id) => document.getElementById(id)?.textContent)];
  return controls.flatMap((one) => [
    ...(namesOf(one).some((words) => words?.trim()) ? [] : [`no name: ${one.outerHTML.slice(0, 80)}`]),
    ...(one.tabIndex >= 0 || one.disabled || one.closest("[role=radiogroup], [role=tablist]") ? []
      : [`the keyboard does not reach ${one.outerHTML.slice(0, 80)}`]),
  ]);
});

/**
 * What is wrong with the page as it is shown now. `figures` selects its figures; null: it has none.
 */
export const faultsOf = async (page, { figures = "figure[data-figure]" } = {}) => {
  const { texts, low } = await lowContrasts(page);
  return [
    ...(texts > 0 ? [] : ["the page has no text"]),
    ...await cutElements(page), ...await smallTexts(page), ...await strayHeads(page),
    ...low.map(({ text, of, ratio }) => `"${text}" (${of}) has a contrast of ${ratio}`),
    ...(figures ? [...await poorFigures(page, figures), ...await firstFigure(page, figures)] : []),
    ...await poorControls(page),
    ...(page.complaints ?? []).map((words) => `the browser says: ${words}`),
  ];
};

const isSettled = (page) => page.evaluate(() => new Promise((done) => {
  requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 50)));
}));

/**
 * Asserts that nothing is wrong with the page at 1280 and 390 pixels, light and dark. `seen` is
 * called with "1280-light" and so on while the page is shown so; the page is left wide and light.
 */
export const assertLooks = async (page, { seen = async () => {}, ...options } = {}) => {
  const faults = [];
  for (const size of sizes) {
    for (const colorScheme of schemes) {
      await page.setViewportSize(size);
      await page.emulateMedia({ colorScheme });
      await page.evaluate(() => scrollTo(0, 0));
      await isSettled(page);
      const view = `${size.width}-${colorScheme}`;
      faults.push(...(await faultsOf(page, options)).map((words) => `${view}: ${words}`));
      await seen(view);
    }
  }
  await page.setViewportSize(sizes[0]);
  await page.emulateMedia({ colorScheme: schemes[0] });
  assert.deepEqual(faults, []);
};
