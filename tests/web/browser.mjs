// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A hapnet-web with its stage, and a Chromium that looks at it.

import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";

const root = new URL("../../", import.meta.url).pathname;
const program = process.env.HAPNET_WEB ?? `${root}build/release/bin/hapnet-web`;
const chromiumPath = process.env.CHROMIUM ?? "/usr/bin/chromium";
const flags = [
  "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
];

const playwright = () => {
  try {
    return createRequire(import.meta.url)("playwright-core");
  } catch {
    return null;
  }
};

/** Why no browser can be started here; false: one can. */
export const missing = () => {
  if (!existsSync(program)) return `${program} is not built`;
  if (!existsSync(chromiumPath)) return `${chromiumPath} is missing`;
  return playwright() ? false : "playwright-core is missing: npm ci in tests/web";
};

/** The path of another program of the same build. */
export const programBeside = (name) => join(dirname(program), name);

/**
 * {address, out, pid, stop} of a hapnet-web that plays its demo, or shows what `more` says; files lie
 * in `out`.
 */
export const startWeb = async (...more) => {
  const out = mkdtempSync(join(tmpdir(), "hapnet-web-"));
  const what = more.includes("--lab") ? [] : ["--stage", "--out", out];
  const child = spawn(program, ["--port", "0", ...what, ...more]);
  const ended = new Promise((resolve) => { child.on("exit", resolve); });
  const address = await new Promise((resolve, reject) => {
    ended.then((code) => reject(new Error(`hapnet-web ended with ${code}`)));
    child.stdout.on("data", (text) => {
      const found = /open (\S+)/.exec(text);
      if (found) resolve(found[1]);
    });
  });
  const last = () => child.kill("SIGTERM"); // whatever ends this program
  process.on("exit", last);
  const stop = async () => {
    process.off("exit", last);
    child.kill("SIGTERM");
    await ended;
    rmSync(out, { recursive: true, force: true });
  };
  return { address, out, pid: child.pid, stop };
};

/** Keeps a picture of the page, for whoever wants to see what a test saw. */
export const keepPicture = (page, name) => {
  const folder = process.env.HAPNET_WEB_PICTURES;
  return folder ? page.screenshot({ path: join(folder, `${name}.png`) }) : undefined;
};

export const startBrowser = (more = []) =>
  playwright().chromium.launch({ executablePath: chromiumPath, args: [...flags, ...more] });

/**
 * Of whatever a page waits for: a busy machine draws a picture in a second, without a card. Asked by
 * the clock, as a page that cannot paint would never ask by its frames.
 */
export const patience = { timeout: 180_000, polling: 200 };

/** A page at that address that counts what the browser complains of, once frames come. */
export const openPage = async (context, address, before = async () => {}) => {
  const page = await context.newPage();
  page.setDefaultTimeout(patience.timeout);
  page.complaints = [];
  page.on("console", (message) => {
    if (message.type() === "error") page.complaints.push(message.text());
  });
  page.on("pageerror", (error) => page.complaints.push(error.message));
  await before(page);
  await page.goto(address);
  const isReady = () => globalThis.hapnet?.model.frame && document.body.dataset.view;
  await page.waitForFunction(isReady, undefined, patience).catch(async (error) => {
    const state = await page.evaluate(() => {
      const { model } = globalThis.hapnet ?? {};
      return { view: document.body.dataset.view, frame: model?.frame?.n, stage: model?.state?.stage };
    });
    throw new Error(`${error.message} ${JSON.stringify({ ...state, complaints: page.complaints })}`);
  });
  return page;
};
