// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor/energy.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::device {

namespace {

constexpr base::Duration power_over{std::chrono::milliseconds{5}};

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

} // namespace

EnergyGuard::EnergyGuard(const EnergyLimits& limits, base::Duration tick)
    : limits_{limits}, tick_s_{base::to_seconds(tick)}
{
    base::ensure(limits.power_max_w > 0.0 && limits.work_max_j > 0.0 && tick > base::Duration{0});
    steps_used_ =
        static_cast<std::size_t>(std::clamp<base::Duration::rep>(power_over / tick, 1, steps_max));
}

void EnergyGuard::pass(const base::Force& held, const base::Position& hip, base::Duration duration)
{
    Step step{.seconds = base::to_seconds(duration)};
    if (placed_) step.moved = hip - hip_;
    hip_ = hip;
    placed_ = true;
    step.work_j = dot(held.value, step.moved.value);
    add(step);

    figures_.net_j += step.work_j;
    figures_.net_max_j = std::max(figures_.net_max_j, figures_.net_j);
    lowest_now_j_ = std::min(lowest_now_j_, figures_.net_j);
    const double lowest_j = std::min(lowest_now_j_, lowest_before_j_);
    figures_.work_5s_max_j = std::max(figures_.work_5s_max_j, figures_.net_j - lowest_j);
    into_piece_ += duration;
    if (into_piece_ >= piece) close_piece();
}

void EnergyGuard::add(const Step& step)
{
    Step& oldest = steps_[next_step_];
    oldest = step;
    next_step_ = next_step_ + 1 < steps_used_ ? next_step_ + 1 : 0;
    // Everything is summed up again, because adding and subtracting would accumulate rounding
    // errors.
    lately_ = {};
    for (std::size_t i = 0; i < steps_used_; ++i) {
        lately_.moved += steps_[i].moved;
        lately_.seconds += steps_[i].seconds;
        lately_.work_j += steps_[i].work_j;
    }
    if (lately_.seconds <= 0.0) return;
    figures_.power_max_w = std::max(figures_.power_max_w, lately_.work_j / lately_.seconds);
}

void EnergyGuard::close_piece()
{
    // A longer gap ends several pieces at once, at most as many as are kept.
    into_piece_ = std::min(into_piece_, static_cast<int>(pieces) * piece);
    for (; into_piece_ >= piece; into_piece_ -= piece) {
        lowest_[next_piece_] = lowest_now_j_;
        next_piece_ = next_piece_ + 1 < pieces ? next_piece_ + 1 : 0;
        lowest_now_j_ = figures_.net_j;
    }
    lowest_before_j_ = *std::min_element(lowest_.begin(), lowest_.end());
}

/// Returns the power that the next tick may have so that the mean of 5 ms stays within the limit.
/// The power of earlier ticks counts as measured, not as estimated.
double EnergyGuard::power_left_w() const
{
    const Step& leaves = steps_[next_step_];
    const double before_s = lately_.seconds - leaves.seconds;
    const double before_j = lately_.work_j - leaves.work_j;
    return (limits_.power_max_w * (before_s + tick_s_) - before_j) / tick_s_;
}

base::Force EnergyGuard::allow(const base::Force& wanted, const base::Velocity& reported)
{
    const double lowest_j = std::min(lowest_now_j_, lowest_before_j_);
    const double left_j = limits_.work_max_j - (figures_.net_j - lowest_j);
    if (left_j <= 0.0) return {};
    const double power_w = std::min({limits_.power_max_w, left_j / reserve_s, power_left_w()});
    // A filtered velocity is smoother, and the difference of positions is more recent.
    glm::dvec3 velocity = reported.value;
    if (lately_.seconds > 0.0) {
        const glm::dvec3 newer = (1.0 / lately_.seconds) * lately_.moved.value;
        if (dot(wanted.value, newer) > dot(wanted.value, velocity)) velocity = newer;
    }
    return without_push(wanted, velocity, power_w);
}

base::Force EnergyGuard::without_push(const base::Force& wanted, const glm::dvec3& velocity,
                                      double power_w) const
{
    constexpr double mobility = behind_s / hand_kg;
    const double pushes_w = dot(wanted.value, velocity);
    if (!(pushes_w > 0.0)) return wanted;
    const double all_w = pushes_w + mobility * dot(wanted.value, wanted.value);
    if (all_w <= power_w) return wanted;
    // The share s of the part along the motion is the solution of s p + m (s^2 along^2 + across^2)
    // = power.
    const double speed_squared = dot(velocity, velocity);
    const glm::dvec3 along = (pushes_w / speed_squared) * velocity;
    const glm::dvec3 across = wanted.value - along;
    const double room_w = power_w - mobility * dot(across, across);
    if (room_w <= 0.0) return {across};
    const double growth_w = mobility * dot(along, along);
    const double share = 2.0 * room_w / // the root that stays exact where growth_w is small
                         (pushes_w + std::sqrt(pushes_w * pushes_w + 4.0 * growth_w * room_w));
    return {across + std::min(1.0, share) * along};
}

} // namespace hapnet::device
