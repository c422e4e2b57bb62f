// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Plays what both sides of a session did, from the JSON that the page carries.
"use strict";
(() => {
  const source = document.getElementById("replays");
  const player = document.querySelector(".player");
  if (!source || !player) return;
  const replays = JSON.parse(source.textContent);
  const find = (name) => player.querySelector("." + name);
  const [algorithm, task, speed] = ["algorithm", "task", "speed"].map(find);
  const [play, time, strip] = ["play", "time", "strip"].map(find);
  const views = { l: find("left"), r: find("right") };
  const mmPerNewton = 25; // how long an arrow is

  /** A column of numbers: 16 bits each, low byte first; or one number for all. */
  const unpack = (column, count) => {
    if (typeof column === "number") return new Float64Array(count).fill(column);
    const bytes = Uint8Array.from(atob(column.data), (c) => c.charCodeAt(0));
    const view = new DataView(bytes.buffer);
    return Float64Array.from({ length: count }, (_, i) => view.getInt16(2 * i, true) * column.step);
  };
  const unpackAll = (replay) => {
    if (replay.unpacked) return;
    for (const [name, column] of Object.entries(replay.columns)) {
      replay.columns[name] = unpack(column, replay.count);
    }
    replay.unpacked = true;
  };

  let replay = null;
  let at = 0; // row, with a fraction
  let last = null; // time stamp of the frame before; null: stopped
  let colours = {};
  const readColours = () => {
    const style = getComputedStyle(document.documentElement);
    for (const name of ["ink", "muted", "line", "cube", "static-cube", "left", "right"]) {
      colours[name] = style.getPropertyValue("--" + name).trim();
    }
  };

  // Oblique: x to the right, y up, z toward the viewer and so down to the left.
  const slant = 0.38;
  const window3d = { left: -150, right: 185, top: 84, bottom: -58 }; // mm, of the picture
  const project = (canvas, x, y, z) => {
    const scale = canvas.width / (window3d.right - window3d.left);
    return [(x - slant * z - window3d.left) * scale, (window3d.top - y + slant * z) * scale];
  };

  const polygon = (canvas, points, fill, stroke) => {
    const context = canvas.getContext("2d");
    context.beginPath();
    points.forEach((p) => context.lineTo(...project(canvas, ...p)));
    context.closePath();
    if (fill) Object.assign(context, { fillStyle: fill }).fill();
    if (stroke) Object.assign(context, { strokeStyle: stroke }).stroke();
  };

  /** The three faces of a box that one sees: top, right, front. */
  const box = (canvas, at, half, { fill, stroke, dash = [] }) => {
    const context = canvas.getContext("2d");
    const [x0, x1] = [at[0] - half[0], at[0] + half[0]];
    const [y0, y1] = [at[1] - half[1], at[1] + half[1]];
    const [z0, z1] = [at[2] - half[2], at[2] + half[2]];
    const faces = [
      [[x0, y1, z0], [x1, y1, z0], [x1, y1, z1], [x0, y1, z1]],
      [[x1, y0, z0], [x1, y1, z0], [x1, y1, z1], [x1, y0, z1]],
      [[x0, y0, z1], [x1, y0, z1], [x1, y1, z1], [x0, y1, z1]],
    ];
    context.save();
    context.setLineDash(dash);
    context.lineWidth = 2.5;
    faces.forEach((face, i) => {
      context.globalAlpha = 1;
      polygon(canvas, face, fill, stroke);
      context.globalAlpha = [0, 0.25, 0.1][i]; // shade
      if (fill) polygon(canvas, face, "#000");
    });
    context.restore();
  };

  const hand = (canvas, place, force, colour) => {
    const context = canvas.getContext("2d");
    const [x, y] = project(canvas, ...place);
    const scale = canvas.width / (window3d.right - window3d.left);
    context.beginPath();
    context.arc(x, y, replay.hip_radius * scale, 0, 2 * Math.PI);
    Object.assign(context, { fillStyle: colour, strokeStyle: colours.ink, lineWidth: 3 }).fill();
    context.stroke();
    const length = force * mmPerNewton * scale;
    if (Math.abs(length) < 3) return;
    const head = Math.sign(length) * Math.min(16, Math.abs(length));
    context.beginPath();
    context.lineWidth = 6;
    context.strokeStyle = colours.ink;
    context.moveTo(x, y - 34);
    context.lineTo(x + length, y - 34);
    context.moveTo(x + length - head, y - 34 - 11);
    context.lineTo(x + length, y - 34);
    context.lineTo(x + length - head, y - 34 + 11);
    context.stroke();
  };

  const place = (prefix, row) => ["x", "y", "z"].map((axis) => replay.columns[prefix + axis][row]);

  const drawSide = (side, row) => {
    const canvas = views[side];
    const other = side === "l" ? "r" : "l";
    const context = canvas.getContext("2d");
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.lineWidth = 1.5;
    for (let x = -120; x <= 180; x += 20) {
      polygon(canvas, [[x, -20, -60], [x, -20, 60]], null, colours.line);
    }
    for (let z = -60; z <= 60; z += 20) {
      polygon(canvas, [[-120, -20, z], [180, -20, z]], null, colours.line);
    }
    const moving = replay.bodies.find((body) => body.movable);
    const fixed = replay.bodies.filter((body) => !body.movable);
    const cube = place(side, row);
    const pink = { fill: colours["static-cube"], stroke: colours.ink };
    const boxes = fixed.map((body) => [body.at, body.half, pink]);
    boxes.push([cube, moving.half, { fill: colours.cube, stroke: colours.ink }]);
    boxes.sort((a, b) => a[0][2] - b[0][2]); // the nearest last
    boxes.forEach((one) => box(canvas, ...one));
    box(canvas, place(other, row), moving.half, { stroke: colours.ink, dash: [9, 7] });
    const colour = colours[side === "l" ? "left" : "right"];
    hand(canvas, place(side + "h", row), replay.columns[side + "fx"][row], colour);
    if (cube[0] < window3d.left || cube[0] > window3d.right) {
      context.font = "28px sans-serif";
      context.fillStyle = colours.ink;
      context.fillText(`the cube has left the picture: x = ${cube[0].toFixed(0)} mm`, 20, 40);
    }
  };

  const drawStrip = (row) => {
    const context = strip.getContext("2d");
    const { lx, rx } = replay.columns;
    const least = (column) => column.reduce((a, b) => Math.min(a, b));
    const most = (column) => column.reduce((a, b) => Math.max(a, b));
    const low = Math.max(-400, Math.min(least(lx), least(rx))); // mm: a cube that flew off is cut
    const high = Math.min(400, Math.max(most(lx), most(rx)));
    const down = (x) => 10 + ((strip.height - 20) * (high - x)) / Math.max(high - low, 1e-9);
    const across = (i) => (strip.width * i) / (replay.count - 1);
    context.clearRect(0, 0, strip.width, strip.height);
    for (const [column, colour] of [[lx, colours.left], [rx, colours.right]]) {
      context.beginPath();
      context.lineWidth = 2.5;
      context.strokeStyle = colour;
      column.forEach((x, i) => context.lineTo(across(i), down(x)));
      context.stroke();
    }
    context.fillStyle = colours.ink;
    context.fillRect(across(row) - 1.5, 0, 3, strip.height);
  };

  const draw = () => {
    const row = Math.min(Math.floor(at), replay.count - 1);
    drawSide("l", row);
    drawSide("r", row);
    drawStrip(row);
    const { lx, rx, lfx, rfx } = replay.columns;
    const seconds = replay.start_s + row * replay.step_s;
    time.value = String(row);
    time.setAttribute("aria-valuetext", `${seconds.toFixed(1)} s`);
    find("clock").textContent = `t = ${seconds.toFixed(2)} s`;
    find("apart").textContent = `copies apart: ${Math.abs(lx[row] - rx[row]).toFixed(1)} mm`;
    const newtons = (column) => `${column[row].toFixed(2)} N`;
    find("forces").textContent = `force on L ${newtons(lfx)}, on R ${newtons(rfx)}`;
  };

  const frame = (now) => {
    if (last === null) return;
    at += ((now - last) / 1000 / replay.step_s) * Number(speed.value);
    last = now;
    if (at >= replay.count - 1) {
      at = replay.count - 1;
      last = null;
      play.textContent = "▶";
    }
    draw();
    if (last !== null) requestAnimationFrame(frame);
  };
  const toggle = () => {
    if (last !== null) {
      last = null;
      play.textContent = "▶";
      return;
    }
    if (at >= replay.count - 1) at = 0;
    last = performance.now();
    play.textContent = "❚❚";
    requestAnimationFrame(frame);
  };
  const goTo = (row) => {
    at = Math.min(Math.max(row, 0), replay.count - 1);
    draw();
  };

  const fill = (select, names) => {
    select.replaceChildren(...names.map((name) => new Option(name, name)));
  };
  const choose = () => {
    const wanted = replays.filter((one) => one.algorithm === algorithm.value);
    const name = task.value;
    fill(task, wanted.map((one) => one.task));
    if (wanted.some((one) => one.task === name)) task.value = name;
    replay = wanted.find((one) => one.task === task.value);
    unpackAll(replay);
    time.max = String(replay.count - 1);
    goTo(at);
  };

  fill(algorithm, [...new Set(replays.map((one) => one.algorithm))]);
  readColours();
  choose();
  goTo(0.2 * replay.count); // at its beginning nothing happens yet
  algorithm.addEventListener("change", choose);
  task.addEventListener("change", choose);
  play.addEventListener("click", toggle);
  time.addEventListener("input", () => goTo(Number(time.value)));
  strip.addEventListener("click", (event) => {
    goTo((event.offsetX / strip.clientWidth) * (replay.count - 1));
  });
  player.addEventListener("keydown", (event) => {
    if (event.target !== player) return; // buttons and sliders have keys of their own
    const steps = (event.shiftKey ? 1 : 0.1) / replay.step_s;
    const actions = {
      " ": toggle,
      ArrowLeft: () => goTo(at - steps),
      ArrowRight: () => goTo(at + steps),
      Home: () => goTo(0),
      End: () => goTo(replay.count - 1),
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    readColours();
    draw();
  });
})();
