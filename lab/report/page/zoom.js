// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Zooms the plots of a .zoom-group along x, all together: by dragging, or by buttons.
"use strict";
(() => {
  /** The distance of about five marks: 1, 2 or 5 times a power of ten. */
  const roundStep = (span) => {
    const power = 10 ** Math.floor(Math.log10(span / 5));
    return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= span / 5);
  };

  const makePlot = (curves) => {
    const box = curves.viewBox.baseVal;
    const [left, width] = [box.x, box.width];
    const [low, high] = [Number(curves.dataset.low), Number(curves.dataset.high)];
    const svg = curves.parentElement.closest("svg");
    const marks = svg.querySelector(".x-marks");
    const down = marks.querySelector("text").getAttribute("y");
    const pixel = (value) => left + (width * (value - low)) / (high - low);
    const show = (from, to) => {
      box.x = pixel(from);
      box.width = pixel(to) - pixel(from);
      const step = roundStep(to - from);
      const texts = [];
      for (let at = Math.ceil(from / step) * step; at <= to; at += step) {
        const text = document.createElementNS(svg.namespaceURI, "text");
        text.setAttribute("x", left + (width * (at - from)) / (to - from));
        text.setAttribute("y", down);
        text.setAttribute("text-anchor", "middle");
        text.textContent = String(Number(at.toPrecision(6)));
        texts.push(text);
      }
      marks.replaceChildren(...texts);
    };
    /** Where a pointer is along the axis, 0 to 1. */
    const share = (event) => {
      const seen = svg.getBoundingClientRect();
      const at = ((event.clientX - seen.left) * svg.viewBox.baseVal.width) / seen.width;
      return Math.min(1, Math.max(0, (at - left) / width));
    };
    return { svg, low, high, left, width, show, share };
  };

  const setUp = (group) => {
    const plots = [...group.querySelectorAll("svg.window")].map(makePlot);
    if (plots.length === 0) return;
    const whole = [Math.min(...plots.map((p) => p.low)), Math.max(...plots.map((p) => p.high))];
    let [from, to] = whole;
    const show = (newFrom, newTo) => {
      const span = Math.min(Math.max(newTo - newFrom, 0.02), whole[1] - whole[0]);
      from = Math.min(Math.max(newFrom, whole[0]), whole[1] - span);
      to = from + span;
      plots.forEach((plot) => plot.show(from, to));
    };
    const scale = (factor) => {
      const middle = (from + to) / 2;
      const half = ((to - from) / 2) * factor;
      show(middle - half, middle + half);
    };
    const move = (share) => show(from + share * (to - from), to + share * (to - from));

    for (const plot of plots) {
      let begin = null;
      let band = null;
      plot.svg.classList.add("zoomable");
      plot.svg.addEventListener("pointerdown", (event) => {
        begin = plot.share(event);
        band = document.createElementNS(plot.svg.namespaceURI, "rect");
        band.setAttribute("y", 34);
        band.setAttribute("height", plot.svg.viewBox.baseVal.height - 78);
        band.setAttribute("fill-opacity", 0.15);
        plot.svg.append(band);
        plot.svg.setPointerCapture(event.pointerId);
      });
      plot.svg.addEventListener("pointermove", (event) => {
        if (band === null) return;
        const ends = [begin, plot.share(event)].sort((a, b) => a - b);
        band.setAttribute("x", plot.left + ends[0] * plot.width);
        band.setAttribute("width", (ends[1] - ends[0]) * plot.width);
      });
      const finish = (event) => {
        if (band === null) return;
        band.remove();
        band = null;
        const ends = [begin, plot.share(event)].sort((a, b) => a - b);
        const wide = event.type === "pointerup" && ends[1] - ends[0] > 0.01;
        if (wide) show(from + ends[0] * (to - from), from + ends[1] * (to - from));
      };
      plot.svg.addEventListener("pointerup", finish);
      plot.svg.addEventListener("pointercancel", finish);
    }

    const buttons = group.querySelector(".zoom-buttons");
    const add = (text, label, action) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = text;
      button.setAttribute("aria-label", label);
      button.addEventListener("click", action);
      buttons.append(button);
    };
    add("+", "zoom in", () => scale(0.5));
    add("−", "zoom out", () => scale(2));
    add("←", "earlier", () => move(-0.25));
    add("→", "later", () => move(0.25));
    add("all", "show all", () => show(...whole));
    group.querySelector(".zoom-help").hidden = false;
  };

  document.querySelectorAll(".zoom-group").forEach(setUp);
})();
