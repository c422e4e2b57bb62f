// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The live connection: sends the token, acknowledges frames, reconnects when it breaks.

import { token } from "./api.js";

const retryMs = [500, 1000, 2000, 4000];

const sentences = {
  4401: "The server does not know this page. Open the address that hapnet-web printed.",
  4429: "Too many pages are open. Close one, then reload.",
};

/** `on`: {hello, history, frame, state, event, reset} by the type of a message, and connection. */
export const openFeed = (on) => {
  let attempt = 0;
  let socket = null;

  const received = (message) => {
    const object = JSON.parse(message.data);
    if (object.type === "frame") socket.send(JSON.stringify({ ack: object.n }));
    if (Object.hasOwn(on, object.type)) on[object.type](object);
  };

  const lost = ({ code }) => {
    if (sentences[code]) {
      on.connection({ open: false, final: true, says: sentences[code] });
      return;
    }
    on.connection({ open: false, final: false, says: "Not connected. Trying again …" });
    setTimeout(connect, retryMs[Math.min(attempt, retryMs.length - 1)]);
    attempt += 1;
  };

  const connect = () => {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    socket = new WebSocket(`${scheme}://${location.host}/live`);
    socket.addEventListener("open", () => {
      attempt = 0;
      socket.send(JSON.stringify({ token }));
      on.connection({ open: true, final: false, says: "" });
    });
    socket.addEventListener("message", received);
    socket.addEventListener("close", lost);
  };
  if (token === "") on.connection({ open: false, final: true, says: sentences[4401] });
  else connect();
  return {
    /** Sends a message of the page; nothing while there is no connection. */
    send: (message) => {
      if (socket?.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message));
    },
  };
};
