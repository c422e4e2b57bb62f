// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// picture.mjs FILE: a picture of the live page, 1440 pixels wide, while the copies are apart.

import { missing, openPage, startBrowser, startWeb } from "./browser.mjs";

const reason = missing();
if (reason) {
  console.error(`picture: ${reason}`);
  process.exit(3);
}
const web = await startWeb();
const browser = await startBrowser();
const context = await browser.newContext({
  viewport: { width: 1440, height: 900 }, colorScheme: "light",
});
const page = await openPage(context, web.address);
await page.waitForFunction(() => {
  const { model } = globalThis.hapnet;
  const apart = model.frame.pairs[0]?.apart_mm;
  return model.frame.peers[0]?.session?.at_s > 12 && apart > 10 && apart < 25;
}, undefined, { timeout: 90_000 });
await page.screenshot({ path: process.argv[2] });
await browser.close();
await web.stop();
