// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/clock_sync.hpp"

#include "proto/base/clock_pair.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hapnet::peer {

namespace {

// The largest offset. Clocks count from a boot, so none is ten years ahead of another.
constexpr base::Duration offset_max{std::chrono::hours{10 * 365 * 24}};
// A round trip counts as free of queueing if it exceeds the shortest by less than `longer_least`,
// or by less than the shortest divided by `longer_share`.
constexpr base::Duration longer_least{std::chrono::microseconds{100}};
constexpr std::int64_t longer_share = 10;
// The noise in an offset, without any queue, that is caused by timers and interrupts.
constexpr double offset_noise_ns = 1e6;

base::Duration rounded(double ns) { return base::Duration{std::llround(ns)}; }

} // namespace

void ClockSync::add(const ClockSample& s)
{
    const base::Duration round_trip = (s.answer_heard - s.sent) - (s.answered - s.heard);
    const Window sample{s.answer_heard, ((s.heard - s.sent) + (s.answered - s.answer_heard)) / 2,
                        round_trip};
    const bool is_believable =
        round_trip >= base::Duration{0} && std::chrono::abs(sample.offset) <= offset_max;
    if (!is_believable || shows_same_clock(sample)) return;
    if (!first_) {
        first_ = s.answer_heard;
        said_at_ = s.answer_heard;
    }
    if (open_ && s.answer_heard - open_since_ >= window) close_window();
    if (!open_) open_since_ = s.answer_heard;
    if (!open_ || sample.round_trip < open_->round_trip) {
        open_ = sample;
        fit_ = fit(s.answer_heard);
    }
    consider(sample);
    follow(s.answer_heard);
}

/// True if this sample is consistent with a shared clock.
bool ClockSync::shows_same_clock(const Window& sample)
{
    if (same_clock_ == SameClock::no) return false;
    if (sample.round_trip / 2 < same_within_) {
        same_clock_ = SameClock::no;
        return false;
    }
    same_round_trip_ = std::min(same_round_trip_, sample.round_trip);
    if (!base::are_two_clocks(sample.offset, sample.round_trip / 2 + same_within_)) {
        same_clock_ = SameClock::seen;
        ruled_out_ = 0;
        return true;
    }
    const bool was_seen = same_clock_ == SameClock::seen;
    if (was_seen && ++ruled_out_ < samples_needed) return true;
    same_clock_ = SameClock::no;
    if (was_seen) { // one of the clocks has jumped
        ++jumps_;
        agreeing_left_ = samples_needed;
    }
    return false;
}

/// Returns the part of a sample's deviation from the estimate that queues and asymmetry cannot
/// explain. It is positive if the sample is ahead, negative if it is behind, and 0 if they agree.
base::Duration ClockSync::unexplained(const Window& sample) const
{
    const base::Duration apart = sample.offset - said_;
    const base::Duration bound = sample.round_trip / 2 + jump_least;
    return apart - std::clamp(apart, -bound, bound);
}

void ClockSync::consider(const Window& sample)
{
    if (sample.at - *first_ < settles_within) return;
    // During a long silence the two clocks drift apart.
    const base::Duration beyond = std::chrono::abs(unexplained(sample));
    const auto drift = [&] {
        return std::chrono::duration_cast<base::Duration>(slew_max *
                                                          std::chrono::abs(sample.at - said_at_));
    };
    if (beyond > base::Duration{0} && beyond > drift()) {
        agreeing_left_ = samples_needed;
    } else if (agreeing_left_ > 0) {
        --agreeing_left_;
    }
}

void ClockSync::close_window()
{
    if (count_ == closed_.size()) {
        std::move(closed_.begin() + 1, closed_.end(), closed_.begin());
        --count_;
    }
    closed_[count_++] = *open_;
    open_.reset();
    if (!has_jumped()) return;
    std::move(closed_.begin() + static_cast<std::ptrdiff_t>(count_ - windows_for_jump),
              closed_.begin() + static_cast<std::ptrdiff_t>(count_), closed_.begin());
    count_ = windows_for_jump;
    ++jumps_;
    agreeing_left_ = samples_needed;
    said_at_ = closed_[count_ - 1].at;
    said_ = fit(said_at_).offset;
}

/// True if all of the last windows deviate from the estimate on the same side.
bool ClockSync::has_jumped() const
{
    if (count_ < windows_for_jump) return false;
    int ahead = 0, behind = 0;
    for (std::size_t i = count_ - windows_for_jump; i < count_; ++i) {
        const base::Duration beyond = unexplained(closed_[i]);
        ahead += static_cast<int>(beyond > base::Duration{0});
        behind += static_cast<int>(beyond < base::Duration{0});
    }
    return std::max(ahead, behind) == static_cast<int>(windows_for_jump);
}

ClockSync::Fit ClockSync::fit(base::TimePoint now) const
{
    // The open window is used as soon as it has a sample.
    const auto each_window = [this](const auto& look) {
        for (std::size_t i = 0; i < count_; ++i) look(closed_[i]);
        if (open_) look(*open_);
    };
    Window best = open_ ? *open_ : closed_[0];
    each_window([&best](const Window& each) {
        if (each.round_trip < best.round_trip) best = each;
    });
    const base::Duration longest =
        best.round_trip + std::max(longer_least, best.round_trip / longer_share);
    // The sums are relative to the best sample, so that equal offsets differ by exactly 0. The part
    // of a round trip beyond the best one may have falsified its offset by half of that part. Each
    // sample's weight is the square of the remaining precision.
    double n = 0.0, w = 0.0, t = 0.0, tt = 0.0, x = 0.0, tx = 0.0, xx = 0.0;
    each_window([&](const Window& each) {
        if (each.round_trip > longest) return;
        const double time = base::to_seconds(each.at - now);
        const auto apart = static_cast<double>((each.offset - best.offset).count());
        const auto longer = static_cast<double>((each.round_trip - best.round_trip).count());
        const double precision = offset_noise_ns / (offset_noise_ns + longer / 2.0);
        const double weight = precision * precision;
        n += 1.0;
        w += weight;
        t += weight * time;
        tt += weight * time * time;
        x += weight * apart;
        tx += weight * time * apart;
        xx += weight * apart * apart;
    });
    const base::Duration half_trip = best.round_trip / 2;
    const Fit best_alone{now, best.offset, half_trip, 0.0};
    if (n < static_cast<double>(windows_for_skew)) return best_alone;
    const double spread = tt - t * t / w;
    const double fitted = spread > 0.0 ? (tx - t * x / w) / spread : 0.0; // ns per s
    // Noise makes a large skew look slightly too large. No crystal deviates by twice this limit.
    constexpr double slope_max = 1e3 * skew_max_ppm;
    if (!(std::abs(fitted) <= 2.0 * slope_max)) return best_alone;
    const double slope = std::clamp(fitted, -slope_max, slope_max);
    const double here = x / w - slope * t / w;
    const double left = std::max(0.0, xx - x * x / w - fitted * fitted * spread);
    const double error = std::sqrt(left / (n - 2.0) * (1.0 / w + (t / w) * (t / w) / spread));
    return {now, best.offset + rounded(here), half_trip + rounded(2.0 * error), 1e-9 * slope};
}

/// Moves the reported offset toward the estimated one.
void ClockSync::follow(base::TimePoint now)
{
    const base::Duration apart = fit_.at_time(now) - said_;
    const base::Duration passed = now - std::exchange(said_at_, now);
    if (apart == base::Duration{0}) return;
    const bool is_settling = now - *first_ < settles_within;
    const base::Duration most = std::chrono::duration_cast<base::Duration>(
        slew_max * std::max(base::Duration{0}, passed)); // receive stamps may step back
    said_ += is_settling ? apart : std::clamp(apart, -most, most);
}

std::optional<ClockEstimate> ClockSync::estimate() const
{
    if (same_clock_ == SameClock::seen)
        return ClockEstimate{.uncertainty = same_within_, .round_trip = same_round_trip_};
    if (!first_) return std::nullopt;
    // The deviation that slewing has not corrected yet is also uncertain.
    const base::Duration behind = std::chrono::abs(fit_.at_time(said_at_) - said_);
    return ClockEstimate{said_, fit_.uncertainty + behind, 1e6 * fit_.skew, {}};
}

} // namespace hapnet::peer
