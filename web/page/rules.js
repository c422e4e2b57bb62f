// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// What charts draw beside their curves: the levels that these are held against, and a moment.

/** About `count` round values from low to high: 1, 2 or 5 times a power of ten apart. */
export const roundMarks = (low, high, count) => {
  const span = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(span));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((one) => one >= span * 0.999);
  const marks = [];
  for (let mark = Math.ceil(low / step) * step; mark <= high + 1e-9 * step; mark += step) {
    marks.push(Number(mark.toPrecision(10)));
  }
  return marks;
};

/**
 * `box` is {left, right, top, bottom, x(value), y(value)} in pixels of the canvas, `ratio` how many
 * of them a CSS pixel is; of the view it takes `levels` and `moment`.
 */
export const paintRules = (context, box, view, colours, ratio) => {
  context.save();
  context.beginPath();
  context.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
  context.clip();
  Object.assign(context, {
    strokeStyle: colours.ink, fillStyle: colours.ink, lineWidth: ratio, textAlign: "right",
    font: `${11 * ratio}px system-ui, sans-serif`,
  });
  for (const { y, name } of view.levels ?? []) {
    const down = box.y(y);
    context.setLineDash([4 * ratio, 4 * ratio]);
    context.beginPath();
    context.moveTo(box.left, down);
    context.lineTo(box.right, down);
    context.stroke();
    context.fillText(name, box.right - 4 * ratio, down - 4 * ratio);
  }
  if (Number.isFinite(view.moment)) {
    const across = box.x(view.moment);
    context.setLineDash([]);
    context.fillRect(across - ratio, box.top, 2 * ratio, box.bottom - box.top);
  }
  context.restore();
};
