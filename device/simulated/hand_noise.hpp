// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"

#include <array>
#include <cstdint>

namespace hapnet::device {

/// The involuntary part of where a hand wants to be, along x: slow wander (0.3 to 0.9 Hz, 2 mm
/// amplitude in all) and physiological tremor (8 to 12 Hz, 0.1 mm). Sums of sines whose
/// frequencies and phases come from the seed, so that it is a pure function of time.
class HandNoise {
public:
    HandNoise(base::Seed seed, std::uint16_t peer_id);

    /// Metres, `seconds` from the start.
    [[nodiscard]] double at(double seconds) const;

private:
    struct Swing {
        double amplitude_m = 0.0;
        double hertz = 0.0;
        double phase = 0.0;
    };
    std::array<Swing, 6> swings_;
};

} // namespace hapnet::device
