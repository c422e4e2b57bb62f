// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A double of hapnet-web that speaks docs/formats/live.md: for tests of the page alone, where no
// program is built. It simulates no physics and no network: see peers.mjs and network.mjs.
import { createServer } from "node:http";
import { readFileSync, readdirSync } from "node:fs";
import { basename, dirname, extname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { Double } from "./double.mjs";
import { accept } from "./websocket.mjs";

const root = join(dirname(fileURLToPath(import.meta.url)), "../../..");
const page = join(root, "web/page");
const modules = {
  "three.module.min.js": "/usr/share/javascript/three/three.min.js",
  "three-LICENSE.txt": "/usr/share/doc/libjs-three/copyright",
};
const sheets = ["palette", "shared", "app", "parts", "figures"]
  .map((name) => `web/page/${name}.css`);
const types = {
  ".js": "text/javascript",
  ".css": "text/css",
  ".html": "text/html; charset=utf-8",
  ".svg": "image/svg+xml",
  ".txt": "text/plain",
};
const policy =
  "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; " +
  "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
const headers = {
  "Content-Security-Policy": policy,
  "X-Content-Type-Options": "nosniff",
  "Referrer-Policy": "no-referrer",
  "Cross-Origin-Opener-Policy": "same-origin",
  "Cross-Origin-Resource-Policy": "same-origin",
  "Cache-Control": "no-store",
};

const answer = (response, status, type, body) => {
  response.writeHead(status, { ...headers, "Content-Type": type });
  response.end(body);
};

/** What makes Debian's three.js a module, as in the build. */
const endOfModule = () => {
  const painters = readdirSync(join(page, "paint"))
    .map((name) => readFileSync(join(page, "paint", name), "utf8")).join("");
  const names = new Set([...painters.matchAll(/three\.([A-Z]\w+)/g)].map(([, name]) => name));
  return readFileSync(join(root, "cmake/debian_three.js.in"), "utf8")
    .replace("@names@", ["REVISION", ...names].join(", "));
};

/** The contents of a file of the page. */
const contentsOf = (name) => {
  if (name === "page.css") return sheets.map((sheet) => readFileSync(join(root, sheet))).join("");
  if (!modules[name]) return readFileSync(join(page, name));
  const text = readFileSync(modules[name], "utf8");
  return name.endsWith(".js") ? `${text}\n${endOfModule()}` : text;
};

const asset = (response, name, withModules) => {
  const known = modules[name]
    ? withModules
    : /^((figures|paint)\/)?[a-z0-9_]+\.(js|css|svg)$/i.test(name);
  try {
    if (!known) throw new Error("not an asset");
    answer(response, 200, types[extname(name)] ?? "text/plain", contentsOf(name));
  } catch {
    answer(response, 404, "text/plain", `no ${basename(name)}`);
  }
};

const readBody = async (request) => {
  let text = "";
  for await (const part of request) text += part;
  return JSON.parse(text);
};

const api = async (double, token, request, response) => {
  const json = (status, object) =>
    answer(response, status, "application/json", JSON.stringify(object));
  if (request.headers["x-hapnet-token"] !== token) {
    return json(401, { ok: false, error: "no token, or a wrong one" });
  }
  try {
    const path = new URL(request.url, "http://localhost").pathname;
    if (path.startsWith("/f/")) return answer(response, 200, "application/octet-stream", "a file");
    const body = request.method === "POST" ? await readBody(request) : null;
    return json(200, double.answer(path, body));
  } catch (error) {
    return json(error.status ?? 422, { ok: false, error: error.message });
  }
};

/** Listens on a free port of loopback; {address, double, close()}. */
export const startDouble = async (options = {}) => {
  const token = "0123456789abcdef";
  const double = new Double(options);
  const server = createServer((request, response) => {
    const path = new URL(request.url, "http://localhost").pathname;
    if (path === "/") {
      const html = readFileSync(join(page, "index.html"), "utf8");
      answer(response, 200, types[".html"], html.replace(/@@([^@]+)@@/g, "/a/0/$1"));
    } else if (path.startsWith("/a/0/")) asset(response, path.slice(5), options.modules !== false);
    else if (path.startsWith("/api/") || path.startsWith("/f/"))
      api(double, token, request, response);
    else answer(response, 404, "text/plain", "no such page");
  });
  server.on("upgrade", (request, socket) => {
    let client = null;
    const connection = accept(
      request,
      socket,
      (text) => {
        const message = JSON.parse(text);
        if (client) client.acked = message.ack ?? client.acked;
        else if (message.token === token) client = double.join(connection);
        else connection.close(4401);
      },
      () => client && double.leave(client),
    );
  });
  await new Promise((resolve) => {
    server.listen(options.port ?? 0, "127.0.0.1", resolve);
  });
  const address = `http://127.0.0.1:${server.address().port}/#t=${token}`;
  const close = () => {
    double.stop();
    server.closeAllConnections();
    server.close();
  };
  return { address, double, close };
};

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  const peers = Number(process.argv[2] ?? 2);
  const { address } = await startDouble({
    port: 8470,
    peers,
    turning: process.argv[3] === "turning",
  });
  console.log(`open ${address}`);
}
