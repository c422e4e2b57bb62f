// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::lab::records {

/// Writes MCAP (https://mcap.dev/spec), version 0, profile ros2: messages in chunks with an index,
/// without compression and checksums.
class McapWriter {
public:
    /// Takes the bytes of the file in their order.
    using Take = std::function<void(std::string_view)>;

    explicit McapWriter(Take take);

    /// Adds a schema of encoding ros2msg. All schemas and channels must be added before the first
    /// message.
    [[nodiscard]] std::uint16_t add_schema(std::string_view name, std::string_view text);
    /// Adds a channel whose messages are encoded as CDR.
    [[nodiscard]] std::uint16_t add_channel(std::uint16_t schema, std::string_view topic);

    /// Adds a message. `time_ns` is the time of logging and of publishing, in nanoseconds since the
    /// zero of the file's times.
    void write(std::uint16_t channel, std::uint64_t time_ns, std::string_view data);

    /// Ends the file.
    void finish();

private:
    /// The times of the messages of a chunk and their offsets in it, by channel.
    using Index = std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>>;
    /// The first and the last of some messages.
    struct Times {
        std::uint64_t first = 0;
        std::uint64_t last = 0;
        std::uint64_t messages = 0;

        void add(std::uint64_t time_ns);
    };

    void emit(std::string_view bytes);
    void end_chunk();

    Take take_;
    std::uint64_t offset_ = 0;
    std::string schemas_;  // schema records, written again in the summary
    std::string channels_; // channel records, written again in the summary
    std::uint16_t schemas_count_ = 0;
    std::map<std::uint16_t, std::uint64_t> messages_by_channel_;
    Times times_;

    std::string chunk_; // message records of the chunk that is being filled
    Index index_;
    Times chunk_times_;
    std::string chunk_indexes_; // chunk index records, written in the summary
    std::uint32_t chunks_ = 0;
};

} // namespace hapnet::lab::records
