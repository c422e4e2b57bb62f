// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "web/core/pairing.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::web {

/// The value of an unknown figure.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The part of a peer's frame that the server uses; pages get the whole text. Figures that are
/// missing in the frame are NaN.
struct PeerFrame {
    struct Heard {
        std::uint16_t from = 0;
        double lost = 0.0;
        double delay_mean_ms = unknown;
        double delay_max_ms = unknown;
        double age_ms = unknown;
        double offset_ms = unknown;
        double uncertainty_ms = unknown;
    };

    std::string text; // the line that was parsed
    Sample cube;
    double force_n = 0.0; // force at the newest tick
    double force_max_n = 0.0;
    double late_max_us = 0.0;
    double missed = 0.0;
    std::string phase;
    std::vector<Heard> heard;
};

/// The part of an emulator's frame that the server uses.
struct EmulatorFrame {
    struct Way {
        double received = 0.0;
        double dropped = 0.0;
        double in_flight = 0.0;
        double delay_mean_ms = unknown;
        double delay_max_ms = unknown;
        double late_max_us = unknown;

        [[nodiscard]] double dropped_share() const
        {
            return received > 0.0 ? dropped / received : unknown;
        }
    };
    struct Path {
        std::string name;
        Way up;
        Way down;
    };

    std::string text;
    std::uint64_t generation = 0;
    base::TimePoint at;
    double elapsed_s = 0.0; // since the emulator's start
    std::vector<Path> paths;
};

/// Parses a frame of a daemon, or of another program in its place. Every number of the result is in
/// its range, and the text is a JSON object.
[[nodiscard]] base::Result<PeerFrame> parse_peer_frame(std::string_view line);
[[nodiscard]] base::Result<EmulatorFrame> parse_emulator_frame(std::string_view line);

} // namespace hapnet::web
