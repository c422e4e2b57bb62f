// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// read.mjs FILE.mcap CSV PEER...: every message of the file, by the official reader, is decoded and
// compared with the rows of `hapnet-lab export --csv`.
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { readFileSync } from "node:fs";
import assert from "node:assert/strict";

const [file, csv, ...peers] = process.argv.slice(2);
const bytes = new Uint8Array(readFileSync(file));
const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
};

const reader = await McapIndexedReader.Initialize({ readable });
assert.equal(reader.header.profile, "ros2");
const decoders = new Map();
for (const [id, schema] of reader.schemasById) {
  assert.equal(schema.encoding, "ros2msg");
  const text = new TextDecoder().decode(schema.data);
  decoders.set(id, new MessageReader(parse(text, { ros2: true })));
}
const topics = new Map(); // messages by topic, in their order
let last = 0n;
for await (const message of reader.readMessages()) {
  assert(message.logTime >= last, "ascending in time");
  last = message.logTime;
  const channel = reader.channelsById.get(message.channelId);
  assert.equal(channel.messageEncoding, "cdr");
  const decoded = decoders.get(channel.schemaId).readMessage(message.data);
  assert.equal(decoded.header.frame_id, "hapnet");
  assert.equal(BigInt(decoded.header.stamp.sec) * 1000000000n +
               BigInt(decoded.header.stamp.nsec ?? decoded.header.stamp.nanosec), message.logTime);
  if (!topics.has(channel.topic)) topics.set(channel.topic, []);
  topics.get(channel.topic).push(decoded);
}
const counts = [...topics.values()].map((messages) => messages.length);
const total = counts.reduce((sum, count) => sum + count, 0);
assert.equal(reader.statistics.messageCount, BigInt(total));
for (const [id, count] of reader.statistics.channelMessageCounts) {
  assert.equal(BigInt(topics.get(reader.channelsById.get(id).topic).length), count);
}

// The same bytes without the index, as they are read from a pipe.
const stream = new McapStreamReader();
stream.append(bytes);
let streamed = 0;
for (let record; (record = stream.nextRecord()); ) streamed += record.type === "Message" ? 1 : 0;
assert(stream.done());
assert.equal(streamed, total);

for (const peer of peers) {
  for (const name of ["hip", "contact_force", "device_force"]) {
    assert(topics.has(`/peer_${peer}/${name}`), `/peer_${peer}/${name}`);
  }
  assert([...topics.keys()].some((topic) => topic.startsWith(`/peer_${peer}/body`)));
}
const lines = readFileSync(csv, "utf8").trimEnd().split("\n");
const [head, ...rows] = lines.map((row) => row.split(","));
const column = (name) => {
  const index = Math.max(head.indexOf(name), head.indexOf(`a_${name}`)); // of two records, A's
  assert(index >= 0, `a column ${name} among ${head}`);
  return rows.map((row) => Number(row[index]));
};
const compare = (topic, value, name, scale) => {
  const messages = topics.get(`/peer_${peers[0]}/${topic}`);
  assert.equal(messages.length, rows.length, topic);
  column(name).forEach((expected, i) => {
    assert(Math.abs(scale * value(messages[i]) - expected) < 1e-6, `${name} of row ${i}`);
  });
};
compare("hip", (message) => message.pose.position.x, "hip_x_mm", 1e3);
compare("hip", (message) => message.pose.position.z, "hip_z_mm", 1e3);
compare("contact_force", (message) => message.wrench.force.x, "contact_x_n", 1);
compare("device_force", (message) => message.wrench.force.y, "device_y_n", 1);
console.log(`${total} messages of ${topics.size} topics read and ${rows.length} rows compared`);
