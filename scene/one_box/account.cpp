// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/account.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace hapnet::scene {

namespace {

/// Returns the energy that a spring stores at a depth. Its force never exceeds its greatest one.
double stored_at(const HandDescription& hands, double depth)
{
    const double bend = hands.force_max_n / hands.stiffness_n_per_m;
    if (depth <= 0.0) return 0.0;
    return depth < bend ? 0.5 * hands.stiffness_n_per_m * depth * depth
                        : hands.force_max_n * (depth - 0.5 * bend);
}

/// True if the box is at a face of an obstacle and moves into it.
bool enters_obstacle(const BoxMotion& box, std::size_t axis, double speed)
{
    const AxisMotion& motion = box.axes[axis];
    return (motion.below && speed < 0.0) || (motion.above && speed > 0.0);
}

/// The energy balance of a tick when all its impulses are scaled by a share.
class Balance {
public:
    Balance(const WorldConfig& config, const WorldState& state, const TickStart& start,
            const BoxMotion& box)
        : config_{config}, state_{state}, start_{start}, box_{box}, end_{box.velocity}
    {
        for (std::size_t i = 0; i < 3; ++i) {
            free_[i] = start.velocity[i] + config.tick * start.steady[i];
            moved_[i] = box.position[i] - start.position[i];
        }
        for (std::uint32_t i = 0; i < config.hands.count; ++i)
            is_touched_ = is_touched_ || state.touches[i].touching;
    }

    [[nodiscard]] bool is_touched() const { return is_touched_; }

    [[nodiscard]] PerAxis velocity(double share) const
    {
        if (share == 1.0) return end_;
        PerAxis v{};
        for (std::size_t i = 0; i < 3; ++i) {
            v[i] = free_[i] + share * (end_[i] - free_[i]);
            if (enters_obstacle(box_, i, v[i])) v[i] = 0.0;
        }
        return v;
    }

    /// True if the box has no more energy than it had plus the energy that it was given.
    [[nodiscard]] bool holds(double share) const
    {
        constexpr double tolerated = 1e-7; // share of the energy that is there
        const double mass = 1.0 / box_.oscillators.inverse_mass();
        const PerAxis after = velocity(share);
        PerAxis mean{};
        PerAxis weight{}; // velocity that the steady forces add
        for (std::size_t i = 0; i < 3; ++i) {
            mean[i] = 0.5 * config_.tick * (start_.velocity[i] + after[i]);
            weight[i] = config_.tick * start_.steady[i];
        }
        const double had = 0.5 * mass * dot(start_.velocity, start_.velocity);
        const double has = 0.5 * mass * dot(after, after);
        const double along = mass * dot(start_.steady, moved_);
        const double steadily = mass * dot(start_.steady, mean);
        const double work = share == 1.0 ? std::max(along, steadily) : steadily;
        const double fastest =
            std::sqrt(std::max(dot(start_.velocity, start_.velocity), dot(after, after)));
        const double slack = tolerated * (had + has + std::abs(work)) + mass * dot(weight, weight);
        return has - had - work - given_by_hands(share, fastest) <= slack;
    }

    /// Returns the greatest force of a hand, as a multiple of its limit.
    [[nodiscard]] double excess() const
    {
        double excess = 0.0;
        for (std::uint32_t i = 0; i < config_.hands.count; ++i) {
            const double force = base::norm(state_.touches[i].on_body);
            if (force > excess * config_.hands.force_max_n)
                excess = force / config_.hands.force_max_n;
        }
        return excess;
    }

private:
    /// Returns the energy that the hands give: the energy that their springs have stored and the
    /// work of their own motion. A hand that holds gives no more than its impulse can give at twice
    /// the known speed of the box. Its spring also pulls, so within a tick it can give and take far
    /// more than that.
    [[nodiscard]] double given_by_hands(double share, double fastest) const
    {
        double given = 0.0;
        double held = share > 0.0 ? start_.stored : 0.0;
        double held_most = 0.0;
        for (std::uint32_t i = 0; i < config_.hands.count; ++i) {
            const HandTouch& touch = state_.touches[i];
            if (!touch.touching) continue;
            const glm::dvec3 impulse = share * config_.tick * touch.on_body.value;
            const double work = glm::dot(impulse, state_.hands[i].velocity.value);
            (touch.holding ? held : given) += work;
            if (touch.holding) {
                held_most += 2.0 * length(impulse) * fastest;
            } else {
                given += stored_at(config_.hands, touch.depth_m);
            }
        }
        return given + std::min(held, held_most);
    }

    const WorldConfig& config_;
    const WorldState& state_;
    const TickStart& start_;
    const BoxMotion& box_;
    PerAxis end_;
    PerAxis free_{}; // the velocity at the end without any impulse
    PerAxis moved_{};
    bool is_touched_ = false;
};

/// Returns nearly the greatest share with which the balance holds. It always holds at 0.
double share_that_holds(const Balance& balance)
{
    constexpr int halvings = 40;
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (balance.holds(middle) ? low : high) = middle;
    }
    return low;
}

} // namespace

void settle(const WorldConfig& config, WorldState& state, const TickStart& start, BoxMotion& box)
{
    constexpr double rounding = 1e-9;
    const Balance balance{config, state, start, box};
    double share = balance.holds(1.0) ? 1.0 : share_that_holds(balance);
    const double excess = balance.excess();
    if (excess > 1.0 + rounding) share = std::min(share, 1.0 / excess);
    if (share == 1.0) return;
    ++(balance.is_touched() ? state.interventions.hands_braked
                            : state.interventions.islands_limited);
    box.velocity = balance.velocity(share);
    for (std::uint32_t i = 0; i < config.hands.count; ++i) {
        HandTouch& touch = state.touches[i];
        touch.on_hand.value += (1.0 - share) * touch.on_body.value;
        touch.on_body.value *= share;
    }
}

} // namespace hapnet::scene
