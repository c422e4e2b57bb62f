// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Starts the modules that a report carries in itself. A page opened from disk may not import files,
// and modules know each other by relative names: each becomes a data: address, under a bare name.
"use strict";
(async () => {
  const file = document.getElementById("modules");
  if (file === null) return;
  const { plain, packed } = JSON.parse(file.textContent);

  const unpacked = async (text) => {
    const bytes = Uint8Array.from(atob(text), (digit) => digit.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).text();
  };
  /** A browser that cannot unpack has the painters of our own. */
  const libraries = async () => {
    try {
      const texts = Object.entries(packed)
        .map(async ([name, text]) => [name, await unpacked(text)]);
      return Object.fromEntries(await Promise.all(texts));
    } catch {
      return {};
    }
  };

  const bare = (name, from) => `hapnet${new URL(name, new URL(from, "file:///")).pathname}`;
  const named = (source, from) =>
    source.replace(/(\bfrom\s*|\bimport\s*\(\s*)"(\.\.?\/[^"]+)"/g, (_, before, name) =>
      `${before}"${bare(name, from)}"`);
  const addressOf = (source) => `data:text/javascript,${encodeURIComponent(source)}`;

  const files = { ...plain, ...(await libraries()) };
  const imports = Object.fromEntries(Object.entries(files)
    .filter(([name]) => name.endsWith(".js"))
    .map(([name, source]) => [bare(name, ""), addressOf(named(source, name))]));
  const map = document.createElement("script");
  map.type = "importmap";
  map.textContent = JSON.stringify({ imports });
  document.head.append(map);
  const { start } = await import("hapnet/report/report.js");
  await start(files);
})();
