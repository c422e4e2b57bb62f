// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Plays what all sides of a session did, from the JSON that the page carries.
"use strict";
(() => {
  const source = document.getElementById("replays");
  const player = document.querySelector(".player");
  if (!source || !player) return;
  const replays = JSON.parse(source.textContent);
  const find = (name) => player.querySelector("." + name);
  const [algorithm, task, speed] = ["algorithm", "task", "speed"].map(find);
  const [play, time, strip, stage] = ["play", "time", "strip", "stage"].map(find);
  const mmPerNewton = 25; // how long an arrow is
  const coloursOfMany = ["sep", "other", "missed", "met", "calibrated", "muted"]; // after L and R

  /** A column of numbers: 16 bits each, low byte first; or one number for all. */
  const unpack = (column, count) => {
    if (typeof column === "number") return new Float64Array(count).fill(column);
    const bytes = Uint8Array.from(atob(column.data), (c) => c.charCodeAt(0));
    const view = new DataView(bytes.buffer);
    return Float64Array.from({ length: count }, (_, i) => view.getInt16(2 * i, true) * column.step);
  };
  const unpackAll = (replay) => {
    if (replay.unpacked) return;
    const columnsOf = (side) => [side.hand, side.force, ...side.bodies];
    for (const columns of replay.sides.flatMap(columnsOf)) {
      for (const [name, column] of Object.entries(columns)) {
        columns[name] = unpack(column, replay.count);
      }
    }
    replay.unpacked = true;
  };

  let replay = null;
  let views = []; // a canvas for each side
  let at = 0; // row, with a fraction
  let last = null; // time stamp of the frame before; null: stopped
  let colours = {};
  const readColours = () => {
    const style = getComputedStyle(document.documentElement);
    const names = ["ink", "muted", "line", "cube", "static-cube", "left", "right"];
    for (const name of [...names, ...coloursOfMany]) {
      colours[name] = style.getPropertyValue("--" + name).trim();
    }
  };
  const colourOf = (index) => colours[["left", "right", ...coloursOfMany][index % 8]];

  const scaled = (v, factor) => v.map((one) => one * factor);
  const plus = (a, b) => a.map((one, i) => one + b[i]);
  const minus = (a, b) => a.map((one, i) => one - b[i]);
  const dot = (a, b) => a.reduce((sum, one, i) => sum + one * b[i], 0);
  const length = (v) => Math.hypot(...v);

  /** A vector turned by a quaternion [w, x, y, z] of length 1. */
  const turned = ([w, x, y, z], [a, b, c]) => {
    const [s, t, u] = [y * c - z * b, z * a - x * c, x * b - y * a].map((one) => 2 * one);
    return [a + w * s + y * u - z * t, b + w * t + z * s - x * u, c + w * u + x * t - y * s];
  };
  const product = ([aw, ax, ay, az], [bw, bx, by, bz]) => [
    aw * bw - ax * bx - ay * by - az * bz,
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
  ];

  // Oblique: x to the right, y up, z toward the viewer and so down to the left.
  const slant = 0.38;
  const towardViewer = [slant, slant, 1];
  const flat = ([x, y, z]) => [x - slant * z, y - slant * z];
  let frame3d = { left: -150, right: 185, top: 84, bottom: -58 }; // mm, of the picture
  const scaleOf = (canvas) => canvas.width / (frame3d.right - frame3d.left);
  const project = (canvas, point) => {
    const [x, y] = flat(point);
    return [(x - frame3d.left) * scaleOf(canvas), (frame3d.top - y) * scaleOf(canvas)];
  };

  /** Eight signs: the corners of a box. */
  const signs = [-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].map((z) => [x, y, z])));
  const cornersOf = (solid) =>
    signs.map((sign) =>
      plus(solid.at, turned(solid.q, sign.map((one, axis) => one * solid.half[axis])))
    );

  /** The picture of the paper's scene, or of more, if something fixed would not fit in. */
  const frameOf = (solids) => {
    const frame = { left: -150, right: 185, top: 84, bottom: -58 };
    for (const [x, y] of solids.flatMap(cornersOf).map(flat)) {
      frame.left = Math.min(frame.left, x - 10);
      frame.right = Math.max(frame.right, x + 10);
      frame.bottom = Math.min(frame.bottom, y - 10);
      frame.top = Math.max(frame.top, y + 10);
    }
    const height = ((frame.right - frame.left) * 382) / 900;
    const missing = height - (frame.top - frame.bottom);
    if (missing > 0) frame.top += missing;
    else {
      frame.left += (missing * 900) / 382 / 2;
      frame.right -= (missing * 900) / 382 / 2;
    }
    return frame;
  };

  const polygon = (canvas, points, fill, stroke) => {
    const context = canvas.getContext("2d");
    context.beginPath();
    points.forEach((p) => context.lineTo(...project(canvas, p)));
    context.closePath();
    if (fill) Object.assign(context, { fillStyle: fill }).fill();
    if (stroke) Object.assign(context, { strokeStyle: stroke }).stroke();
  };

  /** The faces of a box that one sees, at any orientation. */
  const drawBox = (canvas, solid, { fill, stroke }) => {
    const context = canvas.getContext("2d");
    for (const axis of [0, 1, 2]) {
      for (const sign of [-1, 1]) {
        const unit = [0, 1, 2].map((i) => (i === axis ? sign : 0));
        const normal = turned(solid.q, unit);
        if (dot(normal, towardViewer) <= 1e-9) continue;
        const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        const face = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => {
          const corner = scaled(unit, solid.half[axis]);
          corner[u] = a * solid.half[u];
          corner[v] = b * solid.half[v];
          return plus(solid.at, turned(solid.q, corner));
        });
        context.globalAlpha = 1;
        polygon(canvas, face, fill, stroke);
        // Light from above; what faces right is darkest.
        context.globalAlpha = Math.min(0.3, Math.max(0, 0.1 - 0.1 * normal[1] + 0.15 * normal[0]));
        if (fill) polygon(canvas, face, "#000");
      }
    }
    context.globalAlpha = 1;
  };

  /** A sphere or a capsule: round about the line on which its core lies. */
  const drawRound = (canvas, solid, { fill, stroke }) => {
    const context = canvas.getContext("2d");
    const ends = [-1, 1].map((sign) =>
      project(canvas, plus(solid.at, turned(solid.q, scaled(solid.half, sign))))
    );
    const radius = solid.rounding * scaleOf(canvas);
    const along = Math.atan2(ends[1][1] - ends[0][1], ends[1][0] - ends[0][0]);
    context.beginPath();
    context.arc(...ends[1], radius, along - Math.PI / 2, along + Math.PI / 2);
    context.arc(...ends[0], radius, along + Math.PI / 2, along + 1.5 * Math.PI);
    context.closePath();
    if (fill) Object.assign(context, { fillStyle: fill }).fill();
    Object.assign(context, { strokeStyle: stroke }).stroke();
  };

  const drawSolid = (canvas, solid, style) => {
    const context = canvas.getContext("2d");
    context.save();
    context.setLineDash(style.dash || []);
    context.lineWidth = 2.5;
    (solid.rounding > 0 ? drawRound : drawBox)(canvas, solid, style);
    context.restore();
  };

  /** How far a solid reaches along each axis of the scene. */
  const boundsOf = (solid) => {
    const corners = cornersOf(solid);
    return [0, 1, 2].map((axis) => {
      const places = corners.map((corner) => corner[axis]);
      return [Math.min(...places) - solid.rounding, Math.max(...places) + solid.rounding];
    });
  };
  /** By how much b is in front of a, where they are farthest apart; negative: behind. */
  const inFront = (a, b) => {
    let widest = -Infinity;
    let by = 0;
    for (const axis of [0, 1, 2]) {
      for (const [gap, sign] of [
        [b.bounds[axis][0] - a.bounds[axis][1], 1],
        [a.bounds[axis][0] - b.bounds[axis][1], -1],
      ]) {
        if (gap > widest) [widest, by] = [gap, sign];
      }
    }
    return by;
  };
  /** The farthest first: each before all that are in front of it. */
  const inOrder = (solids) => {
    const left = solids.map((solid) => ({ ...solid, bounds: boundsOf(solid) }));
    const order = [];
    while (left.length > 0) {
      const isFree = (one) => left.every((other) => other === one || inFront(one, other) >= 0);
      const next = Math.max(0, left.findIndex(isFree));
      order.push(...left.splice(next, 1));
    }
    return order;
  };

  /** The parts of a body that stands there and so. */
  const solidsOf = (body, place, q, style) =>
    body.parts.map((part) => ({
      at: plus(place, turned(q, part.at)),
      q: product(q, part.q),
      half: part.half,
      rounding: part.rounding,
      style,
    }));

  const vector = (columns, row) => ["x", "y", "z"].map((axis) => columns[axis][row]);
  const orientation = (body, columns, row) => {
    if (!body.turns || !columns.qw) return body.q;
    const q = ["qw", "qx", "qy", "qz"].map((part) => columns[part][row]);
    const size = length(q);
    return size > 0 ? scaled(q, 1 / size) : body.q;
  };
  /** What a side has of the shared bodies. */
  const sharedBy = (side, row, style) =>
    replay.shared.flatMap((number, i) => {
      const body = replay.bodies[number];
      if (!body) return [];
      const columns = side.bodies[i];
      return solidsOf(body, vector(columns, row), orientation(body, columns, row), style);
    });
  const fixedSolids = () =>
    replay.bodies
      .filter((body, number) => !replay.shared.includes(number))
      .flatMap((body) =>
        solidsOf(body, body.at, body.q, { fill: colours["static-cube"], stroke: colours.ink })
      );

  const ball = (canvas, place, style) => {
    const context = canvas.getContext("2d");
    context.save();
    context.beginPath();
    context.arc(...project(canvas, place), replay.hip_radius * scaleOf(canvas), 0, 2 * Math.PI);
    context.setLineDash(style.dash || []);
    Object.assign(context, { strokeStyle: style.stroke, lineWidth: 3 });
    if (style.fill) Object.assign(context, { fillStyle: style.fill }).fill();
    context.stroke();
    context.restore();
  };
  const arrow = (canvas, place, force) => {
    const context = canvas.getContext("2d");
    const [x, y] = plus(project(canvas, place), [0, -34]);
    const [across, up] = flat(scaled(force, mmPerNewton));
    const way = scaled([across, -up], scaleOf(canvas));
    const reach = Math.hypot(...way);
    if (reach < 3) return;
    const head = Math.min(16, reach) / reach;
    const side = (sign) => [
      x + way[0] - head * (way[0] + sign * 0.7 * way[1]),
      y + way[1] - head * (way[1] - sign * 0.7 * way[0]),
    ];
    context.beginPath();
    Object.assign(context, { lineWidth: 6, strokeStyle: colours.ink });
    context.moveTo(x, y);
    context.lineTo(x + way[0], y + way[1]);
    context.moveTo(...side(1));
    context.lineTo(x + way[0], y + way[1]);
    context.lineTo(...side(-1));
    context.stroke();
  };

  const drawSide = (index, row) => {
    const canvas = views[index];
    const side = replay.sides[index];
    const others = replay.sides.filter((one) => one !== side);
    const context = canvas.getContext("2d");
    const floor = replay.floor;
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.lineWidth = 1.5;
    for (let x = -120; x <= 180; x += 20) {
      polygon(canvas, [[x, floor, -60], [x, floor, 60]], null, colours.line);
    }
    for (let z = -60; z <= 60; z += 20) {
      polygon(canvas, [[-120, floor, z], [180, floor, z]], null, colours.line);
    }
    const own = sharedBy(side, row, { fill: colours.cube, stroke: colours.ink });
    for (const solid of inOrder([...fixedSolids(), ...own])) drawSolid(canvas, solid, solid.style);
    const outline = { stroke: colours.ink, dash: [9, 7] };
    for (const other of others) {
      for (const solid of sharedBy(other, row, outline)) drawSolid(canvas, solid, outline);
      const colour = colourOf(replay.sides.indexOf(other));
      ball(canvas, vector(other.hand, row), { stroke: colour, dash: [5, 4] });
    }
    const place = vector(side.hand, row);
    ball(canvas, place, { fill: colourOf(index), stroke: colours.ink });
    arrow(canvas, place, vector(side.force, row));
    const gone = own.find(({ at: [x] }) => x < frame3d.left || x > frame3d.right);
    if (gone) {
      context.font = "28px sans-serif";
      context.fillStyle = colours.ink;
      context.fillText(`a body has left the picture: x = ${gone.at[0].toFixed(0)} mm`, 20, 40);
    }
  };

  /** Which of the shared bodies went farthest along x: its curve is drawn. */
  const farthestMoved = () => {
    const spread = (column) =>
      column.reduce((a, b) => Math.max(a, b)) - column.reduce((a, b) => Math.min(a, b));
    const ways = replay.shared.map((_, i) =>
      Math.max(...replay.sides.map((side) => spread(side.bodies[i].x)))
    );
    return ways.indexOf(Math.max(...ways));
  };

  const drawStrip = (row) => {
    const context = strip.getContext("2d");
    const columns = replay.sides.map((side) => side.bodies[replay.drawn].x);
    const least = (column) => column.reduce((a, b) => Math.min(a, b));
    const most = (column) => column.reduce((a, b) => Math.max(a, b));
    const low = Math.max(-400, Math.min(...columns.map(least))); // mm: what flew off is cut
    const high = Math.min(400, Math.max(...columns.map(most)));
    const down = (x) => 10 + ((strip.height - 20) * (high - x)) / Math.max(high - low, 1e-9);
    const across = (i) => (strip.width * i) / (replay.count - 1);
    context.clearRect(0, 0, strip.width, strip.height);
    columns.forEach((column, index) => {
      context.beginPath();
      context.lineWidth = 2.5;
      context.strokeStyle = colourOf(index);
      column.forEach((x, i) => context.lineTo(across(i), down(x)));
      context.stroke();
    });
    context.fillStyle = colours.ink;
    context.fillRect(across(row) - 1.5, 0, 3, strip.height);
  };

  /** How far any two copies of any body are apart: millimetres and degrees. */
  const apartAt = (row) => {
    let [millimetres, degrees] = [0, 0];
    replay.shared.forEach((number, i) => {
      const body = replay.bodies[number];
      replay.sides.forEach((a, index) => {
        for (const b of replay.sides.slice(index + 1)) {
          const way = minus(vector(a.bodies[i], row), vector(b.bodies[i], row));
          millimetres = Math.max(millimetres, length(way));
          if (!body || !body.turns) continue;
          const alike = dot(...[a, b].map((side) => orientation(body, side.bodies[i], row)));
          const angle = 2 * Math.acos(Math.min(1, Math.abs(alike)));
          degrees = Math.max(degrees, (angle * 180) / Math.PI);
        }
      });
    });
    return { millimetres, degrees };
  };

  const draw = () => {
    const row = Math.min(Math.floor(at), replay.count - 1);
    replay.sides.forEach((_, index) => drawSide(index, row));
    drawStrip(row);
    const seconds = replay.start_s + row * replay.step_s;
    time.value = String(row);
    time.setAttribute("aria-valuetext", `${seconds.toFixed(1)} s`);
    find("clock").textContent = `t = ${seconds.toFixed(2)} s`;
    const { millimetres, degrees } = apartAt(row);
    const turns = replay.shared.some((number) => (replay.bodies[number] || {}).turns);
    find("apart").textContent =
      `copies apart: ${millimetres.toFixed(1)} mm` + (turns ? `, ${degrees.toFixed(1)}°` : "");
    const newtons = ({ name, force }) => `on ${name} ${length(vector(force, row)).toFixed(2)} N`;
    find("forces").textContent = `force ${replay.sides.map(newtons).join(", ")}`;
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

  /** A picture for each side. */
  const setStage = () => {
    views = replay.sides.map((side) => {
      const canvas = document.createElement("canvas");
      Object.assign(canvas, { width: 900, height: 382 });
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", `what ${side.name}’s computer holds: bodies and a hand`);
      return canvas;
    });
    stage.replaceChildren(
      ...views.map((canvas, index) => {
        const figure = document.createElement("figure");
        const caption = document.createElement("figcaption");
        caption.textContent = `what ${replay.sides[index].name}’s computer holds`;
        figure.append(canvas, caption);
        return figure;
      })
    );
    frame3d = frameOf(fixedSolids());
    replay.drawn = farthestMoved();
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
    setStage();
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
