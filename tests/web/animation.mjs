// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Pictures of one size as an animated PNG (https://www.w3.org/TR/png-3/): the first is the picture
// where animations are not understood.

const table = Array.from({ length: 256 }, (_, n) => {
  let value = n;
  for (let bit = 0; bit < 8; bit += 1) value = value & 1 ? (value >>> 1) ^ 0xedb88320 : value >>> 1;
  return value >>> 0;
});

const checksum = (bytes) => {
  let value = 0xffffffff;
  for (const byte of bytes) value = table[(value ^ byte) & 255] ^ (value >>> 8);
  return (value ^ 0xffffffff) >>> 0;
};

const chunk = (type, data) => {
  const body = Buffer.concat([Buffer.from(type, "latin1"), data]);
  const [size, sum] = [Buffer.alloc(4), Buffer.alloc(4)];
  size.writeUInt32BE(data.length);
  sum.writeUInt32BE(checksum(body));
  return Buffer.concat([size, body, sum]);
};

const numbers = (...values) => {
  const bytes = Buffer.alloc(4 * values.length);
  values.forEach((value, i) => bytes.writeUInt32BE(value, 4 * i));
  return bytes;
};

/** {header, pixels}: what IHDR and all IDAT of a picture hold. */
const partsOf = (png) => {
  const parts = { header: null, pixels: [] };
  for (let at = 8; at < png.length;) {
    const size = png.readUInt32BE(at);
    const type = png.toString("latin1", at + 4, at + 8);
    const data = png.subarray(at + 8, at + 8 + size);
    if (type === "IHDR") parts.header = data;
    if (type === "IDAT") parts.pixels.push(data);
    at += size + 12;
  }
  return parts;
};

/** One animated picture, which repeats for ever; each of the pictures stays for so long. */
export const animationOf = (pngs, milliseconds) => {
  const pictures = pngs.map(partsOf);
  const { header } = pictures[0];
  const size = numbers(header.readUInt32BE(0), header.readUInt32BE(4), 0, 0);
  const time = Buffer.from([milliseconds >> 8, milliseconds & 255, 1000 >> 8, 1000 & 255, 0, 0]);
  let sequence = 0;
  const chunks = [chunk("IHDR", header), chunk("acTL", numbers(pngs.length, 0))];
  pictures.forEach(({ pixels }, i) => {
    chunks.push(chunk("fcTL", Buffer.concat([numbers(sequence++), size, time])));
    for (const data of pixels) {
      chunks.push(i === 0 ? chunk("IDAT", data)
        : chunk("fdAT", Buffer.concat([numbers(sequence++), data])));
    }
  });
  chunks.push(chunk("IEND", Buffer.alloc(0)));
  return Buffer.concat([pngs[0].subarray(0, 8), ...chunks]);
};
