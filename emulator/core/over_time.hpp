// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/pulse.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::emulator {

/// The traffic of one direction within a stretch of a run. Copies are not counted.
struct Stretch {
    std::uint64_t received = 0;
    std::uint64_t dropped = 0;
    std::uint64_t bytes_out = 0; // payload bytes that left
    Pulse left;
    std::optional<base::Duration> queue_max; // longest wait in the queue of a rate; nullopt: none

    void add(const Stretch& later);
};

/// A stretch as statistics report it.
struct StretchReport {
    base::Duration from{}; // time since the start of the run
    base::Duration length{};
    Stretch stretch;
};
constexpr auto fields_of(base::Tag<StretchReport>)
{
    using S = StretchReport;
    return base::fields(
        "stretch", base::member("from_s", &S::from, "When it begins, since the start of the run."),
        base::member("length_s", &S::length, "How long it is."),
        base::computed<S>(
            "received", [](const S& one) { return one.stretch.received; },
            "Datagrams that arrived in it."),
        base::computed<S>(
            "dropped", [](const S& one) { return one.stretch.dropped; },
            "Datagrams that were dropped in it, by any cause."),
        base::computed<S>(
            "delivered", [](const S& one) { return one.stretch.left.count; },
            "Datagrams that left in it."),
        base::computed<S>(
            "bytes_out", [](const S& one) { return one.stretch.bytes_out; },
            "Payload of `delivered`."),
        base::computed<S>(
            "delay_ms", [](const S& one) { return one.stretch.left.delay(); },
            "From arrival to departure of what left in it. null: nothing did."),
        base::computed<S>(
            "late_us", [](const S& one) { return one.stretch.left.late(); },
            "Time sent minus time due. null: nothing left."),
        base::computed<S>(
            "queue_max_ms", [](const S& one) { return one.stretch.queue_max; },
            "The longest time in the queue of a `rate` of what the line began to send in it. null: "
            "it sent nothing."));
}

/// Divides a run into stretches of equal length, in memory that is taken at construction. When a
/// run outgrows them, two neighbours become one, so that all stretches are twice as long.
class OverTime {
public:
    static constexpr std::size_t stretches_max = 256;
    static constexpr base::Duration shortest = std::chrono::milliseconds{10};

    explicit OverTime(base::TimePoint start = {});

    /// Returns the stretch of that time. Times before the start belong to the first stretch.
    [[nodiscard]] Stretch& at(base::TimePoint time)
    {
        if (time < begin_ || time >= end_) move_to(time);
        return stretches_[current_];
    }

    /// Returns the stretches from the start to the latest time that was asked for.
    [[nodiscard]] const std::vector<Stretch>& stretches() const { return stretches_; }
    [[nodiscard]] base::Duration length() const { return length_; }
    [[nodiscard]] std::vector<StretchReport> report() const;

private:
    void move_to(base::TimePoint time);
    void halve();

    std::vector<Stretch> stretches_;
    base::TimePoint start_;
    base::Duration length_ = shortest;
    std::size_t current_ = 0;
    base::TimePoint begin_; // start of the current stretch
    base::TimePoint end_;
};

} // namespace hapnet::emulator
