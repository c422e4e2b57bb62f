// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// As much of RFC 6455 as a page's tests need: text messages of one frame, close, ping.
import { createHash } from "node:crypto";

const salt = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";

const frameOf = (opcode, payload) => {
  const { length } = payload;
  const head =
    length < 126 ? Buffer.from([0x80 | opcode, length]) : Buffer.alloc(length < 65536 ? 4 : 10);
  if (length >= 126) {
    head[0] = 0x80 | opcode;
    if (length < 65536) {
      head[1] = 126;
      head.writeUInt16BE(length, 2);
    } else {
      head[1] = 127;
      head.writeBigUInt64BE(BigInt(length), 2);
    }
  }
  return Buffer.concat([head, payload]);
};

/** Takes the connection over; `onText` gets each message. Returns {send, close, isOpen}. */
export const accept = (request, socket, onText, onGone) => {
  const key = createHash("sha1")
    .update(request.headers["sec-websocket-key"] + salt)
    .digest("base64");
  socket.write(
    "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n" +
      `Sec-WebSocket-Accept: ${key}\r\n\r\n`,
  );
  let bytes = Buffer.alloc(0);
  let open = true;
  const gone = () => {
    if (open) onGone();
    open = false;
  };
  const close = (code) => {
    const payload = Buffer.alloc(2);
    payload.writeUInt16BE(code);
    if (open) socket.end(frameOf(8, payload));
    gone();
  };
  socket.on("data", (more) => {
    bytes = Buffer.concat([bytes, more]);
    while (bytes.length >= 6) {
      const length = bytes[1] & 0x7f; // a client's messages here are short
      if (length > 125) return close(1009);
      if (bytes.length < 6 + length) return undefined;
      const payload = Buffer.from(bytes.subarray(6, 6 + length));
      for (let i = 0; i < length; i += 1) payload[i] ^= bytes[2 + (i % 4)];
      const opcode = bytes[0] & 0x0f;
      bytes = bytes.subarray(6 + length);
      if (opcode === 8) return close(1000);
      if (opcode === 1) onText(payload.toString());
    }
    return undefined;
  });
  socket.on("close", gone);
  socket.on("error", gone);
  return {
    send: (text) => open && socket.write(frameOf(1, Buffer.from(text))),
    close,
    get isOpen() {
      return open;
    },
  };
};
