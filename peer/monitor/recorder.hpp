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

/// A record that a separate thread writes, so that a slow disk, network drive or pipe delays no
/// other thread. Rows that do not fit in the queue are dropped and counted. On request, the same
/// thread keeps the last rows in memory, and saves them on order.
class Recorder {
public:
    /// The capacity of the queue: 8 s of ticks and messages of two peers with one body, 2 s of
    /// eight peers, or 1 s of eight peers with eight bodies. This is longer than most stalls of a
    /// disk.
    static constexpr std::size_t rows_max = 16384;

    struct Setup {
        std::optional<record::Writer> writer{}; // record of the whole run
        nlohmann::json config{};                // configuration in the header of saved rows
        record::Layout layout{};
        std::optional<base::Duration> held{}; // time span of the last rows to hold in memory
        std::string keep_in{};                // folder in which held rows are saved
    };

    explicit Recorder(Setup setup);
    /// Does not wait for unwritten rows: see is_done().
    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Adds a row. Never waits. Only one thread may call it.
    void put(const record::Row& row);
    /// Ends the input: the record is completed and closed.
    void close();

    /// Returns the time span of the last rows in memory; nullopt: none are kept.
    [[nodiscard]] std::optional<base::Duration> held() const;
    /// Orders a record of the rows since `from`, and returns its path. Never waits: the complete
    /// file appears soon after. The error says why there will be no file. Only one thread may call
    /// it.
    [[nodiscard]] base::Result<std::string> keep(const std::string& name, base::TimePoint from);
    /// Returns why an ordered record could not be written. Each reason is returned once.
    [[nodiscard]] std::optional<std::string> keep_trouble();

    /// True if nothing is left to do, because all rows are written or lost. Call it after close().
    [[nodiscard]] bool is_done() const;
    /// Returns the error that ended the record; nullptr if the file has accepted all rows so far.
    [[nodiscard]] std::exception_ptr failure() const;
    /// Returns the number of rows that are missing in the record, because the queue was full or the
    /// file refused them.
    [[nodiscard]] std::uint64_t lost() const;
    /// Returns the number of rows written so far. It grows as long as the disk accepts them.
    [[nodiscard]] std::uint64_t written() const;

private:
    struct State;
    std::shared_ptr<State> state_;
};

} // namespace hapnet::peer::monitor
