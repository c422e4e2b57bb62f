// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/governor/trip.hpp"

#include <optional>

namespace hapnet::device {

/// Holds a fault until an operator acts: puts the stylus into its holder, or presses the primary
/// button after it was at rest for a second. Never opens by itself, nor while the device is still
/// at fault.
class FaultLatch {
public:
    [[nodiscard]] bool is_closed() const { return latched_.fault != Fault::none; }
    [[nodiscard]] const Latched& cause() const { return latched_; }

    /// The first cause stays; whether this is it.
    bool close(const Latched& cause);
    void open() { latched_ = {}; }

    /// A sample without fault, `passed` after the one before: whether the operator has just
    /// opened it.
    bool on_sample(const Sample& sample, base::Duration passed);
    /// A sample that is at fault or old: what the operator did before counts no more.
    void on_bad_sample() { seen_.reset(); }

    /// Slower than this the stylus is at rest: a filtered count of an encoder and a tremor are.
    static constexpr double rest_speed_max_m_per_s = 0.05;
    static constexpr base::Duration rest_needed{std::chrono::seconds{1}};

private:
    struct Seen {
        bool docked = false;
        bool pressed = false;
        std::uint16_t presses = 0;
        base::Duration rest{};
    };

    Latched latched_;
    std::optional<Seen> seen_;
};

} // namespace hapnet::device
