// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/space.hpp"
#include "proto/base/time.hpp"
#include "proto/record/rows.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::telemetry {

/// The least and the greatest of some values, and their mean; empty before the first.
class Spread {
public:
    void add(double value)
    {
        min_ = count_ == 0 ? value : std::min(min_, value);
        max_ = count_ == 0 ? value : std::max(max_, value);
        sum_ += value;
        ++count_;
    }

    [[nodiscard]] bool empty() const { return count_ == 0; }
    [[nodiscard]] std::uint64_t count() const { return count_; }
    /// 0 while empty.
    [[nodiscard]] double min() const { return min_; }
    [[nodiscard]] double max() const { return max_; }
    [[nodiscard]] double mean() const
    {
        return count_ == 0 ? 0.0 : sum_ / static_cast<double>(count_);
    }

private:
    double min_ = 0.0;
    double max_ = 0.0;
    double sum_ = 0.0;
    std::uint64_t count_ = 0;
};

/// What was heard of another peer. Counts and `delay_ms` are of the time since the frame before.
struct HeardFrame {
    std::uint16_t from = 0;
    std::uint64_t messages = 0;           // states that arrived
    std::uint64_t lost = 0;               // gaps in their numbers
    std::uint64_t late = 0;               // came after one with a higher number, or again
    Spread delay_ms;                      // sender's stamp to this kernel's stamp
    std::optional<base::Duration> age;    // of the newest state, at the frame's time
    std::optional<base::Duration> offset; // its clock minus this one
    std::optional<base::Duration> offset_uncertainty;
};

/// Where a shared body is, in sessions in which the tick itself does not hold it.
struct BodyFrame {
    std::uint16_t body = 0;
    base::Position position;
    base::Velocity velocity;
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
};

/// The newest state of a peer, and the extremes since the frame before: docs/formats/live.md.
/// Lengths, speeds and forces are SI.
struct Frame {
    std::uint64_t number = 0;
    std::uint64_t left_out = 0; // frames that this one follows and that were not sent
    std::uint16_t peer = 0;
    record::TickRow tick; // the newest
    std::optional<record::SessionRow> session;
    Spread cube_x_m;
    Spread force_n; // that the device was told
    Spread late_us;
    std::uint64_t missed = 0;
    std::vector<BodyFrame> bodies;
    std::vector<HeardFrame> heard;
    std::string_view governor;             // the name of its state
    std::optional<std::string_view> fault; // nullopt: none
};

/// Appends the frame as one JSON object, without a newline.
void append_json(std::string& text, const Frame& frame);

} // namespace hapnet::telemetry
