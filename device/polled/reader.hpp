// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/buttons.hpp"
#include "device/device.hpp"
#include "device/polled/exchange.hpp"

#include <chrono>
#include <optional>

namespace hapnet::device::polled {

/// The grip according to the device's answers, and the fault that their absence means.
class Reader {
public:
    Reader() { sample_.calibrated = false; }

    /// The grip at `now` by the newest answer there is, which may be an old one. Positions and
    /// velocities that are not finite are a fault, and the last ones stay.
    [[nodiscard]] const Sample& read(const Report& report, base::TimePoint now);

    /// An older answer than this is a timeout.
    static constexpr base::Duration silence_max{std::chrono::milliseconds{20}};

private:
    void take(const Report& report, base::TimePoint now);

    Sample sample_;
    Buttons buttons_;
    std::optional<base::TimePoint> heard_;
};

} // namespace hapnet::device::polled
