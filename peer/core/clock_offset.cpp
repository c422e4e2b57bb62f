// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/clock_offset.hpp"

namespace hapnet::peer {

namespace {

// The clocks count from a boot: none is ten years ahead of another.
constexpr base::Duration offset_max{std::chrono::hours{10 * 365 * 24}};

} // namespace

void ClockOffset::add(const ClockSample& s)
{
    const base::Duration round_trip = (s.answer_heard - s.sent) - (s.answered - s.heard);
    const Sample sample{((s.heard - s.sent) + (s.answered - s.answer_heard)) / 2, round_trip};
    const bool believable =
        round_trip >= base::Duration{0} && std::chrono::abs(sample.offset) <= offset_max;
    if (!believable) return;
    if (best_now_ && s.answer_heard - window_start_ >= window) {
        best_before_ = best_now_;
        best_now_.reset();
    }
    if (!best_now_) {
        window_start_ = s.answer_heard;
        best_now_ = sample;
    } else if (sample.round_trip < best_now_->round_trip) {
        best_now_ = sample;
    }
}

std::optional<ClockOffset::Estimate> ClockOffset::estimate() const
{
    if (!best_now_) return std::nullopt;
    const bool before_is_better = best_before_ && best_before_->round_trip < best_now_->round_trip;
    const Sample& best = before_is_better ? *best_before_ : *best_now_;
    return Estimate{best.offset, best.round_trip / 2};
}

} // namespace hapnet::peer
