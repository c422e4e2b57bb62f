// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Requests to the server. The token comes in the address's fragment and is kept by this tab only.

const key = "hapnet-token";

/** What the address's fragment says besides the token: the settings that a link carries. */
export const wanted = new URLSearchParams(location.hash.slice(1));

/** Takes the token out of the address bar; a reload finds it in the tab's storage. */
const takeToken = () => {
  const found = wanted.get("t");
  wanted.delete("t");
  if (found) {
    sessionStorage.setItem(key, found);
    const rest = String(wanted);
    history.replaceState(null, "", location.pathname + (rest === "" ? "" : `#${rest}`));
  }
  return found ?? sessionStorage.getItem(key) ?? "";
};

export const token = takeToken();

const answerOf = async (response) => {
  const body = await response.json().catch(() => ({}));
  if (response.ok && body.ok !== false) return body;
  throw new Error(body.error ?? `the server answered ${response.status}`);
};

const ask = async (path, options) => {
  const headers = { "X-Hapnet-Token": token, ...options.headers };
  let response;
  try {
    response = await fetch(path, { ...options, headers, cache: "no-store" });
  } catch {
    throw new Error("hapnet-web does not answer: is it still running?");
  }
  return response;
};

export const get = async (path) => answerOf(await ask(path, {}));

/** Sends an object; resolves to the reply, or throws an Error with the server's sentence. */
export const post = async (path, request) =>
  answerOf(await ask(path, {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(request),
  }));

/** Fetches a file, which needs the token, and hands it to the browser as a download. */
export const download = async (href, name) => {
  const response = await ask(href, {});
  if (!response.ok) return answerOf(response);
  const address = URL.createObjectURL(await response.blob());
  const link = document.createElement("a");
  link.href = address;
  link.download = name.split("/").pop();
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
  return { ok: true };
};
