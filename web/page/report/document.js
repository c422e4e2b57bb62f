// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The words, tables and figures of a page, from its data. A text is a string, or a list of strings
// and of {b}, {code}, {a, href} and {badge, style}; a block has one key that says what it is.

import { make } from "../dom.js";
import { spansOf } from "../figures/curves.js";
import { makeFigure } from "../figures/figure.js";
import { Zoom } from "../figures/zoom.js";

/** Microseconds as people write them, where programs have "12 us" or "late, us". */
const spoken = (text) => String(text).replace(/(\d |, |\()us\b/g, "$1µs");

const pieceOf = (piece) => {
  if (typeof piece === "string") return spoken(piece);
  if ("b" in piece) return make("b", {}, spoken(piece.b));
  if ("code" in piece) return make("code", {}, piece.code);
  if ("a" in piece) return make("a", { href: piece.href }, piece.a);
  return make("span", { class: `badge ${piece.style}` }, piece.badge);
};
const textOf = (text) => [text].flat().map(pieceOf);

/** Roles are told: a table that is stacked would lose them. */
const cellOf = (heads) => (cell, i) => {
  const { text, style } = typeof cell === "object" && "text" in cell ? cell : { text: cell };
  if (i === 0)
    return make("th", { scope: "row", role: "rowheader", class: style }, ...textOf(text));
  const said = [heads[i] ?? ""].flat().map((piece) => (typeof piece === "string" ? piece : piece.b))
    .join("").replaceAll("\n", " ");
  return make("td", { role: "cell", class: style, "data-head": said },
    make("span", {}, ...textOf(text)));
};

/** A head stands as the cells below it do. */
const styleOfColumn = (rows, i) => rows[0]?.[i]?.style;

/** A table that is wider than its place has its cells below each other: nothing of it is cut. */
const stackWhereTooWide = (place, table) => {
  new ResizeObserver(() => {
    table.classList.remove("stacked");
    table.classList.toggle("stacked", table.offsetWidth > place.clientWidth);
  }).observe(place);
  return place;
};

const tableOf = ({ caption, heads, rows }) => {
  const table = make("table", { role: "table" }, make("caption", {}, caption),
    make("thead", { role: "rowgroup" }, make("tr", { role: "row" }, ...heads.map((head, i) =>
      make("th", { scope: "col", role: "columnheader", class: styleOfColumn(rows, i) },
        ...textOf(head))))),
    make("tbody", { role: "rowgroup" }, ...rows.map((row) =>
      make("tr", { role: "row" }, ...row.map(cellOf(heads))))));
  return stackWhereTooWide(make("div", { class: "table" }, table), table);
};

const listOf = (lines) => make("ul", {}, ...lines.map((line) => make("li", {}, ...textOf(line))));

const bannerOf = ({ banner, style, list }) => make("div", {
  class: `banner ${style}`, role: style === "missed" ? "alert" : undefined,
}, make("p", {}, ...textOf(banner)), list?.length > 0 ? listOf(list) : null);

const claimsOf = (lists) => make("div", { class: "three" }, ...lists.map(({ title, style, list }) =>
  make("div", { class: `claims ${style}` }, make("h3", {}, `${title} (${list.length})`),
    list.length > 0 ? listOf(list) : make("p", { class: "none" }, "nothing"))));

const buttonsOf = (zoom) => [
  ["+", "zoom in", () => zoom.scale(0.5)],
  ["−", "zoom out", () => zoom.scale(2)],
  ["←", "earlier", () => zoom.move(-0.25)],
  ["→", "later", () => zoom.move(0.25)],
  ["all", "show all", () => zoom.reset()],
].map(([words, label, onclick]) =>
  make("button", { type: "button", "aria-label": label, onclick }, words));

const namesIn = (block) => (block.figure ? [block.figure] : (block.blocks ?? []).flatMap(namesIn));

/** Makes the elements of a page; `figures` are those made so far, by their id. */
export class Document {
  figures = {};
  #zooms = new Map(); // of figures that zoom together: {zoom, group}
  #groups = 0;

  constructor(data) {
    this.data = data;
    this.byId = new Map(data.figures.map((figure) => [figure.id, figure]));
  }

  #figure(id) {
    const data = this.byId.get(id);
    const alone = () => ({ zoom: new Zoom(spansOf(data).x, data.x.scale === "log"), group: id });
    const options = data.kind === "curves" ? this.#zooms.get(id) ?? alone() : {};
    const figure = makeFigure(data, options);
    this.figures[id] = figure;
    const links = (data.sources ?? []).flatMap((path, i) => [i > 0 ? ", " : "",
      make("a", { href: path.split("/").map(encodeURIComponent).join("/") }, path)]);
    return make("figure", { "data-figure": id }, figure.root,
      make("figcaption", {}, ...(data.caption === data.title ? [] : textOf(data.caption)),
        " ",
        links.length > 0 ? make("span", { class: "source" }, "Data: ", ...links) : null));
  }

  /** Figures that show the same x: they zoom and point together. */
  #zoomed(blocks) {
    const names = blocks.flatMap(namesIn).filter((id) => this.byId.get(id).kind === "curves");
    const spans = names.map((id) => spansOf(this.byId.get(id)).x);
    const zoom = new Zoom([
      Math.min(...spans.map(([low]) => low)), Math.max(...spans.map(([, high]) => high)),
    ]);
    this.#groups += 1;
    names.forEach((id) => this.#zooms.set(id, { zoom, group: `zoom-${this.#groups}` }));
    return make("div", { class: "zoom-group" },
      make("p", { class: "zoom-help" }, "Drag across a plot to zoom; all follow. ",
        make("span", { class: "zoom-buttons" }, ...buttonsOf(zoom))), ...this.blocks(blocks));
  }

  #block(block) {
    if ("p" in block) return make("p", { class: block.style }, ...textOf(block.p));
    if ("heading" in block) return make("h3", {}, block.heading);
    if ("table" in block) return tableOf(block.table);
    if ("figure" in block) return this.#figure(block.figure);
    if ("banner" in block) return bannerOf(block);
    if ("list" in block) return listOf(block.list);
    if ("pre" in block) return make("pre", {}, block.pre);
    if ("claims" in block) return claimsOf(block.claims);
    if ("zoomed" in block) return this.#zoomed(block.blocks);
    if ("panels" in block) {
      return make("div", { class: `panels ${block.panels}` }, ...this.blocks(block.blocks));
    }
    if ("folded" in block) {
      return make("details", {}, make("summary", {}, ...textOf(block.folded)),
        ...this.blocks(block.blocks));
    }
    if ("player" in block) return make("div", { class: "player" });
    throw new Error(`unknown block: ${Object.keys(block)}`);
  }

  blocks(list) { return list.map((block) => this.#block(block)); }

  /** Fills the page. */
  fill(main) {
    const { title, lead, head, sections, foot } = this.data;
    const contents = sections.map(({ id, title: name }) =>
      make("li", {}, make("a", { href: `#${id}` }, name)));
    main.append(make("header", {}, make("h1", {}, title), make("p", { class: "lead" }, lead),
      ...this.blocks(head),
      contents.length < 2 ? null : make("details", { class: "contents" },
        make("summary", {}, "Contents"),
        make("nav", { "aria-label": "contents" }, make("ul", {}, ...contents)))));
    for (const { id, title: name, blocks } of sections) {
      main.append(make("section", { id, "aria-labelledby": `${id}-title` },
        make("h2", { id: `${id}-title` }, name), ...this.blocks(blocks)));
    }
    if (foot) main.append(make("footer", {}, make("p", {}, foot)));
  }
}
