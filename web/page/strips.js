// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Charts without a library: lines and bands on a canvas, with a scale. Where uPlot is missing.

const [left, bottom, top, right] = [44, 20, 8, 8];

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

/** A chart in the element: {update(data, window, most, colours), resize()}. */
export const makeChart = (element) => {
  const canvas = document.createElement("canvas");
  canvas.setAttribute("aria-hidden", "true");
  element.append(canvas);
  const context = canvas.getContext("2d");
  let size = { width: 0, height: 0 };

  const resize = () => {
    const ratio = Math.min(2, devicePixelRatio);
    size = { width: element.clientWidth, height: element.clientHeight };
    Object.assign(canvas, { width: size.width * ratio, height: size.height * ratio });
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
  };

  const scales = (from, most) => ({
    x: (time) => left + ((time - from) / -from) * (size.width - left - right),
    y: (value) => size.height - bottom - (value / most) * (size.height - bottom - top),
  });

  const axes = (from, most, { x, y }, colours) => {
    context.font = "11px system-ui, sans-serif";
    Object.assign(context, { fillStyle: colours.muted, strokeStyle: colours.line, lineWidth: 1 });
    context.textAlign = "right";
    for (const mark of roundMarks(0, most, 4)) {
      context.fillText(String(mark), left - 6, y(mark) + 4);
      context.beginPath();
      context.moveTo(left, Math.round(y(mark)) + 0.5);
      context.lineTo(size.width - right, Math.round(y(mark)) + 0.5);
      context.stroke();
    }
    context.textAlign = "center";
    roundMarks(from, 0, 5).forEach((mark) =>
      context.fillText(
        mark === 0 ? "now" : `${mark} s`,
        Math.min(x(mark), size.width - 16),
        size.height - 5,
      ),
    );
  };

  const band = (times, series, { x, y }, colour) => {
    context.beginPath();
    times.forEach((time, i) => {
      if (series.most[i] !== null) context.lineTo(x(time), y(series.most[i]));
    });
    for (let i = times.length - 1; i >= 0; i -= 1) {
      if (series.least[i] !== null) context.lineTo(x(times[i]), y(series.least[i]));
    }
    context.globalAlpha = 0.22;
    context.fillStyle = colour;
    context.fill();
    context.globalAlpha = 1;
  };

  const line = (times, values, { x, y }, curve, colour) => {
    context.beginPath();
    let pen = false;
    times.forEach((time, i) => {
      if (values[i] === null) {
        pen = false;
        return;
      }
      if (pen) context.lineTo(x(time), y(values[i]));
      else context.moveTo(x(time), y(values[i]));
      pen = true;
    });
    context.setLineDash(curve.dash ? [5, 4] : []);
    Object.assign(context, { strokeStyle: colour, lineWidth: curve.dash ? 1.25 : 1.75 });
    context.stroke();
    context.setLineDash([]);
  };

  /** `times` are seconds before now, `from` the first of the window, `most` the top. */
  const update = ({ times, series, curves }, from, most, colours) => {
    if (size.width !== element.clientWidth) resize();
    context.clearRect(0, 0, size.width, size.height);
    const scale = scales(from, most);
    axes(from, most, scale, colours);
    curves.forEach((curve, i) => {
      if (curve.hidden) return;
      const colour = colours[curve.colour];
      if (curve.band) band(times, series[i], scale, colour);
      line(times, series[i][curve.show === "most" ? "most" : "value"], scale, curve, colour);
    });
  };
  return { update, resize, destroy: () => canvas.remove() };
};
