// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "proto/record/writer.hpp"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace hapnet::peer::monitor {

/// A record that a thread of its own writes: a disk, a network drive or a pipe that does not take
/// it delays no other thread. Rows that find no room are dropped and counted. The same thread holds
/// the last rows in memory, where that is asked for, and saves them on order.
class Recorder {
public:
    /// 8 s of ticks and messages of two peers with one body, 2 s of eight, 1 s of eight with eight
    /// bodies: longer than most stalls of a disk.
    static constexpr std::size_t rows_max = 16384;

    struct Setup {
        std::optional<record::Writer> writer{}; // record of the whole run
        nlohmann::json config{};                // configuration in the header of saved rows
        record::Layout layout{};
        std::optional<base::Duration> held{}; // time span of the last rows to hold in memory
        std::string keep_in{};                // folder in which held rows are saved
    };

    explicit Recorder(Setup setup);
    /// Waits for nothing: see is_done().
    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// From one thread. Never waits.
    void put(const record::Row& row);
    /// No more rows come: the record is finished and closed.
    void close();

    /// The time span of the last rows that it holds; nullopt: none.
    [[nodiscard]] std::optional<base::Duration> held() const;
    /// Orders a record of the rows since that time; gives its path. Never waits: the file appears,
    /// whole, soon after. The error says why there will be none. From one thread.
    [[nodiscard]] base::Result<std::string> keep(const std::string& name, base::TimePoint from);
    /// Returns once why an ordered record could not be written.
    [[nodiscard]] std::optional<std::string> keep_trouble();

    /// After close(): whether nothing is left to do, as all is written or lost.
    [[nodiscard]] bool is_done() const;
    /// Returns the error that cut off the record; null: the file has taken all rows so far.
    [[nodiscard]] std::exception_ptr failure() const;
    /// Rows that are missing in the record: they found no room in the queue, or the file refused.
    [[nodiscard]] std::uint64_t lost() const;
    /// Rows that are written, ever: it grows as long as the disk takes them.
    [[nodiscard]] std::uint64_t written() const;

private:
    struct State;
    std::shared_ptr<State> state_;
};

} // namespace hapnet::peer::monitor
