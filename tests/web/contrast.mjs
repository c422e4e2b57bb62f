// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// How much the texts of a page stand out from what is behind them, by the colours that the browser
// has computed: WCAG 2.1, 1.4.3 (AA).

/** {texts, low}: how many texts are seen, and those below 4.5:1, or 3:1 where they are large. */
export const lowContrasts = (page) => page.evaluate(() => {
  /** [red, green, blue, alpha], each 0 to 1. */
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d", { willReadFrequently: true });
  const read = (colour) => {
    context.clearRect(0, 0, 1, 1);
    context.fillStyle = colour;
    context.fillRect(0, 0, 1, 1);
    return [...context.getImageData(0, 0, 1, 1).data].map((part) => part / 255);
  };
  const over = (top, bottom) => [0, 1, 2]
    .map((i) => top[3] * top[i] + (1 - top[3]) * bottom[i]).concat(1);
  const luminance = (colour) => {
    const [red, green, blue] = colour.slice(0, 3)
      .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
  };
  const contrast = (a, b) => {
    const [dark, light] = [luminance(a), luminance(b)].sort((one, other) => one - other);
    return (light + 0.05) / (dark + 0.05);
  };
  const chain = (element) => (element ? [element, ...chain(element.parentElement)] : []);
  const root = read(getComputedStyle(document.documentElement).backgroundColor);
  const page = over(root, matchMedia("(prefers-color-scheme: dark)").matches
    ? [0.07, 0.07, 0.07, 1] : [1, 1, 1, 1]);
  const groundOf = (element) => chain(element).reverse()
    .reduce((ground, one) => over(read(getComputedStyle(one).backgroundColor), ground), page);
  const isSeen = (element) => element.checkVisibility({ opacityProperty: true,
    visibilityProperty: true }) && element.getBoundingClientRect().width > 2;
  const isOff = (element) => element.closest(":disabled, [aria-disabled=true]") !== null;

  const words = [...document.querySelectorAll("body *")].filter((element) => isSeen(element) &&
    !isOff(element) && !element.closest("select, svg") &&
    [...element.childNodes].some((node) => node.nodeType === 3 && node.data.trim() !== ""));
  const fields = [...document.querySelectorAll("input, select, textarea")].filter((element) =>
    isSeen(element) && !isOff(element) && !["range", "checkbox"].includes(element.type));
  const low = [];
  for (const element of [...words, ...fields]) {
    const style = getComputedStyle(element);
    const ground = groundOf(element);
    const opacity = chain(element).reduce((all, one) => all * getComputedStyle(one).opacity, 1);
    const [red, green, blue, alpha] = read(style.color);
    const ratio = contrast(over([red, green, blue, alpha * opacity], ground), ground);
    const size = parseFloat(style.fontSize);
    const isLarge = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
    if (ratio >= (isLarge ? 3 : 4.5)) continue;
    const text = (element.value ?? element.textContent).trim().slice(0, 40);
    low.push({ text, of: `${element.tagName}.${element.className}`, ratio: ratio.toFixed(2) });
  }
  return { texts: words.length + fields.length, low };
});
