// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/buttons.hpp"
#include "device/device.hpp"
#include "device/polled/exchange.hpp"

#include <chrono>
#include <optional>

namespace hapnet::device::polled {

/// Derives the state of the grip from the device's answers, and faults from missing answers.
class Reader {
public:
    Reader() { sample_.calibrated = false; }

    /// Returns the state of the grip at `now` from the newest available answer, which may be an old
    /// one. Positions and velocities that are not finite are a fault, and the last valid ones stay.
    [[nodiscard]] const Sample& read(const Report& report, base::TimePoint now);

    /// The greatest age of an answer. An older one is a timeout.
    static constexpr base::Duration silence_max{std::chrono::milliseconds{20}};

private:
    void take(const Report& report, base::TimePoint now);

    Sample sample_;
    Buttons buttons_;
    std::optional<base::TimePoint> heard_;
};

} // namespace hapnet::device::polled
