// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/record/rows.hpp"
#include "proto/telemetry/frame.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace hapnet::telemetry {

/// Functions that return names for values that the row of a tick contains as numbers. `fault`
/// returns "none" without a fault.
struct Names {
    std::string_view (*governor)(std::uint8_t state) = nullptr;
    std::string_view (*fault)(std::uint8_t fault) = nullptr;
};

/// Reduces the many rows of a peer to few frames, without losing extremes between two frames. Feed
/// it with take() and hear(), drain it with next(). Does no I/O and reads no clock.
class Decimator {
public:
    /// `names` must contain both functions.
    Decimator(std::uint16_t peer, const Names& names) : names_{names} { frame_.peer = peer; }

    void take(const record::TickRow& tick);
    void take(const record::SessionRow& session);
    void take(const record::BodyRow& body);
    /// Takes a received message of another peer. Messages other than states are ignored.
    void hear(std::uint16_t from, base::TimePoint received_at, std::span<const std::byte> message);

    /// Returns the frame of all input since the previous frame; nullopt before the first tick.
    [[nodiscard]] std::optional<Frame> next(std::uint64_t left_out = 0);

private:
    /// Data about another peer that its next frame does not contain.
    struct Other {
        std::uint32_t session = 0;
        std::uint32_t highest = 0;           // highest number in that session; 0: none yet
        std::optional<base::TimePoint> sent; // sending time of the newest state, sender's clock
    };

    [[nodiscard]] std::size_t place_of(std::uint16_t id);
    void begin_anew();

    Names names_;
    Frame frame_; // the frame that is being filled
    bool has_tick_ = false;
    std::vector<Other> others_; // in the order of frame_.heard
};

} // namespace hapnet::telemetry
