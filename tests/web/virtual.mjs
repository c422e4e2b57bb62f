// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// What the tests of virtual time share: a hapnet-web that plays in it, and its page in a browser.

import { after, before } from "node:test";

import { missing, openPage, patience, startBrowser, startWeb } from "./browser.mjs";

/**
 * {skip, web, browser, page, until, pace, paceIs} for all tests of a file. `opened(page)` is called
 * before the first of them.
 */
export const openVirtual = (opened) => {
  const shown = {
    skip: missing(),
    until: (what, value) => shown.page.waitForFunction(what, value, patience),
    pace: () => shown.page.evaluate(() => globalThis.hapnet.model.state.pace),
    paceIs: (state) => shown.until((wanted) =>
      globalThis.hapnet.model.state.pace?.state === wanted, state),
  };
  before(async () => {
    if (shown.skip) return;
    [shown.web, shown.browser] = await Promise.all([startWeb("--virtual"), startBrowser()]);
    shown.page = await openPage(await shown.browser.newContext(), shown.web.address);
    opened(shown.page);
  });
  after(async () => {
    await shown.browser?.close();
    await shown.web?.stop();
  });
  return shown;
};
