// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/buttons.hpp"
#include "device/device.hpp"
#include "device/hdapi/device_cycle.hpp"

#include <chrono>
#include <optional>

namespace hapnet::device::hdapi {

/// Derives the state of the stylus from the library's reports, and faults from missing reports.
class Stylus {
public:
    /// Makes the state of a device that is calibrated in this style.
    explicit Stylus(int style) : style_{style} { sample_.calibrated = false; }

    /// Returns the state of the stylus at `now` from the newest available report, which may be an
    /// old one.
    [[nodiscard]] const Sample& read(const Report& report, base::TimePoint now);

    static constexpr base::Duration silence_max{std::chrono::milliseconds{20}};
    /// After a communication error for this many cycles, the device counts as gone.
    static constexpr std::uint64_t gone_after_cycles = 100;

private:
    void take(const Report& report, base::TimePoint now);
    [[nodiscard]] Fault fault_of_report(const Report& report);

    int style_;
    Sample sample_;
    Buttons buttons_;
    std::uint64_t errors_seen_ = 0; // cycle of the latest error that was reported
    std::optional<base::TimePoint> heard_;
};

} // namespace hapnet::device::hdapi
