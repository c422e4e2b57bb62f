// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Makes elements without any HTML text: data from outside can only become text.

/** An element; of `members` those that start with "on" are listeners, the others attributes. */
export const make = (name, members = {}, ...children) => {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(members)) {
    if (value === undefined || value === null) continue;
    if (value === false && !key.startsWith("aria-")) continue;
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else element.setAttribute(key, value === true && !key.startsWith("aria-") ? "" : String(value));
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
};

/**
 * Sets the text only where it differs, so that nothing is laid out or read out anew. True if it
 * did.
 */
export const say = (element, text) => {
  const differs = element.textContent !== text;
  if (differs) element.textContent = text;
  return differs;
};

export const byId = (id) => document.getElementById(id);

/** Fills a select with [value, text] pairs, and keeps the choice where it is still there. */
export const fillSelect = (select, pairs, chosen) => {
  const signature = JSON.stringify(pairs);
  if (select.dataset.signature !== signature) {
    select.dataset.signature = signature;
    const kept = select.value;
    select.replaceChildren(...pairs.map(([value, text]) => make("option", { value }, text)));
    if (pairs.some(([value]) => value === kept)) select.value = kept;
  }
  if (chosen !== undefined && document.activeElement !== select) select.value = chosen;
};

/** Tells screen readers, politely, and nobody else. */
export const announce = (text) => say(byId("announcer"), text);
