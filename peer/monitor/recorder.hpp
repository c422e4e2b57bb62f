// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/record/writer.hpp"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>

namespace hapnet::peer::monitor {

/// A record that a thread of its own writes: a disk, a network drive or a pipe that does not take
/// it keeps nobody else from anything. Rows that find no room are dropped and counted.
class Recorder {
public:
    /// 8 s of ticks and messages of two peers with one body, 2 s of eight, 1 s of eight with eight
    /// bodies: longer than most stalls of a disk.
    static constexpr std::size_t rows_max = 16384;

    explicit Recorder(record::Writer writer);
    /// Waits for nothing: see is_done().
    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// From one thread. Never waits.
    void put(const record::Row& row);
    /// No more rows come: the record is finished and closed.
    void close();

    /// After close(): whether nothing is left to do, as all is written or the file has refused.
    [[nodiscard]] bool is_done() const;
    /// Why the record ends early; null: the file has not refused.
    [[nodiscard]] std::exception_ptr failure() const;
    /// Rows that found no room.
    [[nodiscard]] std::uint64_t lost() const;
    /// Rows that are written, ever: it grows as long as the disk takes them.
    [[nodiscard]] std::uint64_t written() const;

private:
    struct State;
    std::shared_ptr<State> state_;
};

} // namespace hapnet::peer::monitor
