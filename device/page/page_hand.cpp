// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/page/page_hand.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::device {

base::Result<base::Position> parse_page_place(double x, double y, double z)
{
    const base::Position place{{x, y, z}};
    for (const int axis : {0, 1, 2}) {
        if (std::abs(place.value[axis]) <= page_reach_m) continue; // false for NaN
        return base::fail(fmt::format("\"{}\" must be a number of metres from {} to {}",
                                      "xyz"[axis], -page_reach_m, page_reach_m));
    }
    return place;
}

PageHand::PageHand(std::shared_ptr<HandWishes> wishes) : wishes_{std::move(wishes)}
{
    base::ensure(wishes_ != nullptr);
    identity_ = {.backend = "page", .serial = "", .model = "a hand on a page"};
}

Sample PageHand::read(base::TimePoint now)
{
    const bool is_told = wishes_->take();
    if (has_start_ && is_told) hear(wishes_->value(), now);
    const bool is_held = heard_ && now - *heard_ <= lets_go_after;
    if (is_held) go(now);
    last_ = now;
    return hand_.sample({.hip = hip_, .gripping = is_held && grips_, .docked = !is_held}, now);
}

void PageHand::hear(const std::optional<HandWish>& wish, base::TimePoint now)
{
    if (!wish) return heard_.reset();
    const base::Duration apart = heard_ ? now - *heard_ : base::Duration{0};
    goal_ = wish->place;
    grips_ = wish->grips;
    arrives_ = last_.value_or(now) + std::min(apart, goes_for_max); // moves from this tick on
    heard_ = now;
}

void PageHand::go(base::TimePoint now)
{
    const base::Duration passed = std::min(now - last_.value_or(now), step_max);
    const base::Duration remaining = arrives_ - now + passed;
    base::Displacement step = goal_ - hip_;
    const bool arrives = remaining <= passed;
    if (!arrives) step.value *= base::to_seconds(passed) / base::to_seconds(remaining);
    const double far = base::norm(step);
    const double farthest = speed_max_m_per_s * base::to_seconds(passed);
    if (far > farthest) {
        hip_.value += (farthest / far) * step.value;
    } else {
        hip_ = arrives ? goal_ : hip_ + step;
    }
}

} // namespace hapnet::device
