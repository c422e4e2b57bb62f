// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// As much of a document as drawing SVG takes, for tests without a browser.

class Element {
  constructor(name) { Object.assign(this, { name, attributes: {}, children: [], style: {} }); }

  setAttribute(key, value) { this.attributes[key] = value; }
  getAttribute(key) { return this.attributes[key]; }
  append(...children) { this.children.push(...children); }

  /** All elements of that name below this one. */
  all(name) {
    return this.children.flatMap((child) =>
      [...(child.name === name ? [child] : []), ...child.all(name)]);
  }
}

globalThis.document = { createElementNS: (_, name) => new Element(name) };
