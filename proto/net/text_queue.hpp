// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

namespace hapnet::net {

/// Writes text to a terminal, a pipe or a log on a separate thread, so that the program never waits
/// for the reader. The queue is bounded: a text that does not fit is dropped whole and counted.
/// Text that is unwritten when the process ends is lost.
class TextQueue {
public:
    static constexpr std::size_t bytes_max = std::size_t{256} << 10;

    /// Writes to `descriptor`, which the caller keeps.
    explicit TextQueue(int descriptor);
    /// Does not wait for unwritten text: see is_done().
    ~TextQueue();
    TextQueue(const TextQueue&) = delete;
    TextQueue& operator=(const TextQueue&) = delete;

    /// Adds text. May be called from any thread.
    void put(std::string_view text);

    /// True if all text was written, dropped or refused.
    [[nodiscard]] bool is_done() const;
    /// Returns the number of bytes written so far. It grows as long as the reader reads.
    [[nodiscard]] std::uint64_t written() const;
    /// Returns the number of texts that were dropped, for lack of space or because the descriptor
    /// refused them.
    [[nodiscard]] std::uint64_t lost() const;
    /// Returns the error number of the first write that was refused; 0 if none was.
    [[nodiscard]] int error() const;

private:
    struct State;
    std::shared_ptr<State> state_;
};

} // namespace hapnet::net
