// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/governor.hpp"

#include <chrono>

namespace hapnet::test {

/// A governor that is called once per millisecond, each time with a new sample of a healthy device.
class Governed {
public:
    explicit Governed(const device::GovernorLimits& limits = {}) : governor{limits} {}

    /// Returns a governor at full strength, at rest.
    static Governed ramped_in(const device::GovernorLimits& limits = {})
    {
        Governed governed{limits};
        for (int i = 0; i <= 1001; ++i) governed({});
        return governed;
    }

    /// The force of the next tick.
    base::Force operator()(const base::Force& wanted, bool permitted = true)
    {
        return after(std::chrono::milliseconds{1}, wanted, permitted);
    }
    base::Force after(base::Duration gap, const base::Force& wanted, bool permitted = true)
    {
        if (speaks) ++sample.sequence;
        now += gap;
        given = governor.govern({wanted, permitted}, sample, now);
        return given.force();
    }
    /// Plays this number of ticks. Returns the force of the last.
    base::Force play(int ticks, const base::Force& wanted, bool permitted = true)
    {
        for (int i = 0; i < ticks; ++i) (*this)(wanted, permitted);
        return given.force();
    }

    device::Governor governor;
    device::Sample sample;
    bool speaks = true; // the device sends new samples
    device::GovernedForce given;
    base::TimePoint now{std::chrono::hours{1}};
};

inline base::Force along_x(double newtons) { return {{newtons, 0.0, 0.0}}; }

} // namespace hapnet::test
