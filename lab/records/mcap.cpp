// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/mcap.hpp"

#include <algorithm>
#include <concepts>
#include <utility>

namespace hapnet::lab::records {

namespace {

/// The opcodes of the records that are written.
enum class Opcode : std::uint8_t {
    header = 0x01,
    footer = 0x02,
    schema = 0x03,
    channel = 0x04,
    message = 0x05,
    chunk = 0x06,
    message_index = 0x07,
    chunk_index = 0x08,
    statistics = 0x0b,
    summary_offset = 0x0e,
    data_end = 0x0f,
};

constexpr std::string_view magic{"\x89MCAP0\r\n", 8};
constexpr std::size_t chunk_bytes = 1 << 20;
constexpr std::uint32_t no_checksum = 0;

/// Appends a value in little-endian order.
void put(std::string& out, std::unsigned_integral auto value)
{
    for (std::size_t i = 0; i < sizeof value; ++i)
        out += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xff);
}

void put_text(std::string& out, std::string_view text)
{
    put(out, static_cast<std::uint32_t>(text.size()));
    out += text;
}

std::string record(Opcode opcode, std::string_view content)
{
    std::string out(1, static_cast<char>(opcode));
    put(out, std::uint64_t{content.size()});
    return out += content;
}

} // namespace

McapWriter::McapWriter(Take take) : take_{std::move(take)}
{
    emit(magic);
    std::string header;
    put_text(header, "ros2");
    put_text(header, "hapnet");
    emit(record(Opcode::header, header));
}

std::uint16_t McapWriter::add_schema(std::string_view name, std::string_view text)
{
    const auto id = ++schemas_count_;
    std::string content;
    put(content, id);
    put_text(content, name);
    put_text(content, "ros2msg");
    put_text(content, text);
    const auto whole = record(Opcode::schema, content);
    emit(whole);
    schemas_ += whole;
    return id;
}

std::uint16_t McapWriter::add_channel(std::uint16_t schema, std::string_view topic)
{
    const auto id = static_cast<std::uint16_t>(messages_by_channel_.size());
    messages_by_channel_[id] = 0;
    std::string content;
    put(content, id);
    put(content, schema);
    put_text(content, topic);
    put_text(content, "cdr");
    put(content, std::uint32_t{0}); // no metadata
    const auto whole = record(Opcode::channel, content);
    emit(whole);
    channels_ += whole;
    return id;
}

void McapWriter::write(std::uint16_t channel, std::uint64_t time_ns, std::string_view data)
{
    index_[channel].emplace_back(time_ns, chunk_.size());
    std::string content;
    put(content, channel);
    put(content, static_cast<std::uint32_t>(messages_by_channel_[channel]++));
    put(content, time_ns);
    put(content, time_ns);
    content += data;
    chunk_ += record(Opcode::message, content);
    times_.add(time_ns);
    chunk_times_.add(time_ns);
    if (chunk_.size() >= chunk_bytes) end_chunk();
}

void McapWriter::finish()
{
    end_chunk();
    std::string data_end;
    put(data_end, no_checksum);
    emit(record(Opcode::data_end, data_end));

    std::string statistics;
    put(statistics, times_.messages);
    put(statistics, schemas_count_);
    put(statistics, static_cast<std::uint32_t>(messages_by_channel_.size()));
    put(statistics, std::uint32_t{0}); // no attachments
    put(statistics, std::uint32_t{0}); // no metadata
    put(statistics, chunks_);
    put(statistics, times_.first);
    put(statistics, times_.last);
    constexpr std::size_t entry_bytes = 10;
    put(statistics, static_cast<std::uint32_t>(entry_bytes * messages_by_channel_.size()));
    for (const auto& [channel, count] : messages_by_channel_) {
        put(statistics, channel);
        put(statistics, count);
    }

    const auto summary_start = offset_;
    std::string offsets;
    const auto emit_group = [&](Opcode opcode, std::string_view records) {
        if (records.empty()) return;
        std::string content(1, static_cast<char>(opcode));
        put(content, offset_);
        put(content, std::uint64_t{records.size()});
        offsets += record(Opcode::summary_offset, content);
        emit(records);
    };
    emit_group(Opcode::schema, schemas_);
    emit_group(Opcode::channel, channels_);
    emit_group(Opcode::statistics, record(Opcode::statistics, statistics));
    emit_group(Opcode::chunk_index, chunk_indexes_);
    std::string footer;
    put(footer, summary_start);
    put(footer, offset_);
    put(footer, no_checksum);
    emit(offsets);
    emit(record(Opcode::footer, footer));
    emit(magic);
}

void McapWriter::Times::add(std::uint64_t time_ns)
{
    first = messages == 0 ? time_ns : std::min(first, time_ns);
    last = std::max(last, time_ns);
    ++messages;
}

void McapWriter::emit(std::string_view bytes)
{
    take_(bytes);
    offset_ += bytes.size();
}

void McapWriter::end_chunk()
{
    if (chunk_.empty()) return;
    const std::uint64_t size = chunk_.size();
    std::string content;
    put(content, chunk_times_.first);
    put(content, chunk_times_.last);
    put(content, size);
    put(content, no_checksum);
    put_text(content, ""); // not compressed
    put(content, size);
    content += chunk_;
    const auto start = offset_;
    emit(record(Opcode::chunk, content));
    const auto length = offset_ - start;

    std::string offsets; // where the message index of each channel begins
    const auto indexes_start = offset_;
    for (const auto& [channel, entries] : index_) {
        put(offsets, channel);
        put(offsets, offset_);
        std::string list;
        for (const auto& [time_ns, at] : entries) {
            put(list, time_ns);
            put(list, at);
        }
        std::string index;
        put(index, channel);
        put_text(index, list);
        emit(record(Opcode::message_index, index));
    }

    std::string index;
    put(index, chunk_times_.first);
    put(index, chunk_times_.last);
    put(index, start);
    put(index, length);
    put_text(index, offsets);
    put(index, offset_ - indexes_start);
    put_text(index, ""); // not compressed
    put(index, size);
    put(index, size);
    chunk_indexes_ += record(Opcode::chunk_index, index);
    ++chunks_;
    chunk_.clear();
    index_.clear();
    chunk_times_ = {};
}

} // namespace hapnet::lab::records
