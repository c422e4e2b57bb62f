// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

namespace hapnet::net {

/// Text for a terminal, a pipe or a log, written by a separate thread: the program never waits for
/// the reader. Bounded: a text without room is dropped whole, and counted. Text that is unwritten
/// when the process ends is lost.
class TextQueue {
public:
    static constexpr std::size_t bytes_max = std::size_t{256} << 10;

    /// Writes to `descriptor`, which stays the caller's.
    explicit TextQueue(int descriptor);
    /// Waits for nothing: see is_done().
    ~TextQueue();
    TextQueue(const TextQueue&) = delete;
    TextQueue& operator=(const TextQueue&) = delete;

    /// Adds text. May be called from any thread.
    void put(std::string_view text);

    /// True if all text was written, dropped or refused.
    [[nodiscard]] bool is_done() const;
    /// Number of bytes written so far. It grows as long as the reader takes them.
    [[nodiscard]] std::uint64_t written() const;
    /// Texts that were dropped: for want of room, or because the descriptor refused.
    [[nodiscard]] std::uint64_t lost() const;
    /// The error number of the first write that was refused; 0: no write was refused.
    [[nodiscard]] int error() const;

private:
    struct State;
    std::shared_ptr<State> state_;
};

} // namespace hapnet::net
