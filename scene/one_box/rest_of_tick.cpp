// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/rest_of_tick.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hapnet::scene {

namespace {

using Matrix = std::array<PerAxis, 3>;

/// A force along a spring, and its growth per metre of depth.
struct Push {
    double force = 0.0;
    double slope = 0.0;
};

/// Returns the mean force of a spring and damper over a change of depth at constant speed. It is
/// the change of the stored energy per metre, so that the spring gives back the energy that it
/// took.
Push mean_push(const HandDescription& hands, double from, double to, double time)
{
    const double k = hands.stiffness_n_per_m;
    const double c = hands.damping_ns_per_m;
    const double bend = hands.force_max_n / k; // beyond this depth the force does not grow any more
    const double change = to - from;
    Push push;
    const bool is_linear = std::min(from, to) >= 0.0 && std::max(from, to) <= bend;
    if (is_linear) {
        push = {0.5 * k * (from + to), 0.5 * k};
    } else if (std::max(from, to) > 0.0) {
        const auto force = [&](double depth) {
            return depth >= bend ? hands.force_max_n : k * std::max(depth, 0.0);
        };
        const double low = std::clamp(from, 0.0, bend);
        const double high = std::clamp(to, 0.0, bend);
        const double beyond = std::max(to - bend, 0.0) - std::max(from - bend, 0.0);
        if (change != 0.0) {
            const double limited = beyond != 0.0 ? hands.force_max_n * beyond : 0.0;
            push.force = (0.5 * k * (high - low) * (high + low) + limited) / change;
            push.slope = std::clamp((force(to) - push.force) / change, 0.0, k);
        } else {
            push.force = force(to);
        }
    }
    push.force += c * change / time;
    push.slope += c / time;
    if (push.force < 0.0 || push.force > hands.force_max_n)
        push = {std::clamp(push.force, 0.0, hands.force_max_n), 0.0};
    return push;
}

/// Solves a symmetric positive definite 3x3 system.
PerAxis solve(Matrix a, PerAxis b)
{
    for (std::size_t k = 0; k < 3; ++k) { // Gauss: no pivots are needed
        for (std::size_t i = k + 1; i < 3; ++i) {
            const double factor = a[i][k] / a[k][k];
            for (std::size_t j = k; j < 3; ++j) a[i][j] -= factor * a[k][j];
            b[i] -= factor * b[k];
        }
    }
    for (std::size_t k = 3; k-- > 0;) {
        for (std::size_t j = k + 1; j < 3; ++j) b[k] -= a[k][j] * b[j];
        b[k] /= a[k][k];
    }
    return b;
}

/// The step, which finds the displacement of the box. Its equation, that momentum changes by the
/// impulses, is the gradient of a convex function.
class Step {
public:
    explicit Step(const BoxMotion& box)
        : box_{box},
          time_{box.time_left},
          mass_{1.0 / box.oscillators.inverse_mass()},
          drag_{mass_ * box.oscillators.of(0, box.is_on_plane).oscillator.damping}
    {}

    /// Fixes the displacement of an axis.
    void fix(std::size_t axis, double way)
    {
        is_fixed_[axis] = true;
        way_[axis] = way;
    }
    [[nodiscard]] bool is_fixed(std::size_t axis) const { return is_fixed_[axis]; }
    [[nodiscard]] const PerAxis& way() const { return way_; }

    void solve_way()
    {
        constexpr int iterations_max = 30;
        constexpr double rounding = 1e-14;
        for (std::size_t i = 0; i < 3; ++i) {
            if (!is_fixed_[i]) way_[i] = time_ * box_.velocity[i];
        }
        for (int i = 0; i < iterations_max; ++i) {
            Matrix slope{};
            const PerAxis left = excess(way_, &slope);
            PerAxis change = solve(slope, left);
            for (double& part : change) part = -part;
            const double falls = dot(left, change); // the convex function along the change
            if (!(falls < 0.0)) return;
            const double share = share_of(change, falls);
            double most = 0.0;
            double size = 0.0;
            for (std::size_t k = 0; k < 3; ++k) {
                way_[k] += share * change[k];
                most = std::max(most, std::abs(share * change[k]));
                size = std::max(size, std::abs(way_[k]) + time_ * std::abs(box_.velocity[k]));
            }
            if (most <= rounding * size) return;
        }
    }

    /// Records the impulses and moves the box on. Returns the impulse on it.
    PerAxis commit(BoxMotion& box) const
    {
        PerAxis sum{};
        for (std::size_t i = 0; i < 3; ++i)
            sum[i] = time_ * mass_ * box.axes[i].applied_acceleration - drag_ * way_[i];
        const auto book = [&](auto& spring) {
            const double to = depth_after(spring, way_);
            const double impulse = time_ * mean_push(box.hands, spring.depth, to, time_).force;
            spring.impulse += impulse;
            spring.depth = to;
            spring.add_along(sum, -impulse);
        };
        for (FaceSpring& spring : box.active_springs()) book(spring);
        for (SlantedSpring& spring : box.active_slanted()) book(spring);
        for (GripSpring& grip : box.active_grips()) {
            for (std::size_t i = 0; i < 3; ++i) {
                const double impulse = time_ * pull(grip, i, way_[i]);
                grip.impulse[i] += impulse;
                grip.stretch[i] += time_ * grip.velocity[i] - way_[i];
                sum[i] += impulse;
            }
        }
        return sum;
    }

private:
    template <typename AnySpring>
    [[nodiscard]] double depth_after(const AnySpring& spring, const PerAxis& way) const
    {
        return spring.depth + time_ * spring.closing + spring.along(way);
    }
    [[nodiscard]] double pull(const GripSpring& grip, std::size_t i, double way) const
    {
        const double stretched = time_ * grip.velocity[i] - way;
        return box_.hands.stiffness_n_per_m * (grip.stretch[i] + 0.5 * stretched) +
               box_.hands.damping_ns_per_m * stretched / time_;
    }

    /// Returns the momentum that a displacement takes in excess of the impulses, per time.
    PerAxis excess(const PerAxis& way, Matrix* slope) const
    {
        PerAxis left{};
        const double inertia = 2.0 * mass_ / (time_ * time_);
        const double grips =
            0.5 * box_.hands.stiffness_n_per_m + box_.hands.damping_ns_per_m / time_;
        for (std::size_t i = 0; i < 3; ++i) {
            left[i] = inertia * (way[i] - time_ * box_.velocity[i]) + drag_ / time_ * way[i] -
                      mass_ * box_.axes[i].applied_acceleration;
            for (const GripSpring& grip : box_.active_grips()) left[i] -= pull(grip, i, way[i]);
            if (slope) (*slope)[i][i] = inertia + drag_ / time_ + box_.grip_count * grips;
        }
        const auto add = [&](const auto& spring) {
            const Push push = mean_push(box_.hands, spring.depth, depth_after(spring, way), time_);
            spring.add_along(left, push.force);
            if (!slope || push.slope == 0.0) return;
            PerAxis normal{};
            spring.add_along(normal, 1.0);
            for (std::size_t i = 0; i < 3; ++i)
                spring.add_along((*slope)[i], push.slope * normal[i]);
        };
        for (const FaceSpring& spring : box_.active_springs()) add(spring);
        for (const SlantedSpring& spring : box_.active_slanted()) add(spring);
        for (std::size_t i = 0; i < 3; ++i) {
            if (!is_fixed_[i]) continue;
            left[i] = 0.0;
            if (!slope) continue;
            for (std::size_t j = 0; j < 3; ++j) (*slope)[i][j] = (*slope)[j][i] = 0.0;
            (*slope)[i][i] = 1.0;
        }
        return left;
    }

    /// Returns the share of a change to take: the one at which the convex function is lowest along
    /// the change.
    double share_of(const PerAxis& change, double falls) const
    {
        constexpr int tries_max = 40;
        constexpr double near = 0.1; // share of the slope at the start: as good as level
        double low = 0.0;
        double high = 1.0;
        double share = 1.0;
        for (int i = 0; i < tries_max; ++i) {
            PerAxis there = way_;
            for (std::size_t k = 0; k < 3; ++k) there[k] += share * change[k];
            const double slope = dot(excess(there, nullptr), change);
            if (slope <= -near * falls && (share == 1.0 || slope >= near * falls)) break;
            (slope > 0.0 ? high : low) = share;
            share = 0.5 * (low + high);
        }
        return share;
    }

    const BoxMotion& box_;
    double time_;
    double mass_;
    double drag_; // N s/m
    std::array<bool, 3> is_fixed_{};
    PerAxis way_{};
};

struct Hit {
    double time; // share of the step: 0 at its start, 1 at its end
    std::size_t axis;
    double way; // displacement along that axis to the face
};

/// Returns where the straight path of a step first meets an obstacle.
std::optional<Hit> first_hit(const BoxMotion& box, const PerAxis& way)
{
    std::optional<Hit> first;
    for (const std::uint32_t id : box.nearby) {
        const Obstacle& obstacle = box.obstacles[id];
        Hit in{-1.0, 3, 0.0};
        double out = 1.0;
        bool meets = true;
        for (std::size_t i = 0; i < 3 && meets; ++i) {
            if (obstacle.is_plane && i != obstacle.normal_axis) continue;
            const double place = box.position[i];
            const double gap = obstacle.gap(i, place);
            const double side = obstacle.side(i, place);
            const double closing = -side * way[i];
            if (gap >= 0.0) {
                meets = closing > gap;
                const double time = gap / closing;
                const bool is_later = time > in.time;
                const bool is_supported = time == in.time && box.axes[i].support;
                if (meets && (is_later || is_supported))
                    in = {time, i, obstacle.face(i, side) - place};
            }
            if (way[i] == 0.0) continue;
            const double far = obstacle.face(i, way[i] > 0.0 ? 1.0 : -1.0);
            out = std::min(out, (far - place) / way[i]);
        }
        if (!meets || in.axis == 3 || in.time >= out) continue;
        if (!first || in.time < first->time) first = in;
    }
    return first;
}

/// Applies dry friction, which reduces the speed along the supports as far as it can.
void rub(BoxMotion& box, const Step& step, const PerAxis& pressing)
{
    double limit = 0.0; // m/s
    double square = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (step.is_fixed(i) && box.axes[i].support) {
            const bool is_below = box.axes[i].support == box.axes[i].below;
            const double load = is_below ? -pressing[i] : pressing[i];
            limit += box.axes[i].support->material.friction * std::max(load, 0.0);
        }
        if (!step.is_fixed(i)) square += box.velocity[i] * box.velocity[i];
    }
    limit *= box.oscillators.inverse_mass();
    const double speed = std::sqrt(square);
    for (std::size_t i = 0; i < 3; ++i) {
        if (step.is_fixed(i) || speed == 0.0) continue;
        box.velocity[i] *= std::max(1.0 - limit / speed, 0.0);
    }
}

} // namespace

bool finish_tick(BoxMotion& box)
{
    Step step{box};
    const bool is_stuck = box.dry_friction.state == DryFriction::State::stuck;
    for (std::size_t i = 0; i < 3; ++i) {
        if (box.axes[i].is_stopped || box.axes[i].support || is_stuck) step.fix(i, 0.0);
    }
    constexpr int tries_max = 8;
    bool is_stopped = false;
    std::array<double, 3> faces{};
    std::array<bool, 3> is_at_face{};
    for (int tries = 0;; ++tries) {
        step.solve_way();
        const double reach =
            std::max({std::abs(step.way()[0]), std::abs(step.way()[1]), std::abs(step.way()[2])});
        box.nearby = box.obstacles.nearby(box.position, reach);
        const auto hit = first_hit(box, step.way());
        if (!hit) break;
        if (tries == tries_max) { // between more faces than that the box stays where it is
            for (const std::size_t i : {0U, 1U, 2U}) step.fix(i, 0.0);
            is_at_face = {};
            is_stopped = true;
            break;
        }
        step.fix(hit->axis, hit->way);
        is_at_face[hit->axis] = true;
        faces[hit->axis] = box.position[hit->axis] + hit->way;
    }
    const PerAxis impulse = step.commit(box);
    PerAxis pressing{}; // N s: impulse on what holds the fixed axes
    for (std::size_t i = 0; i < 3; ++i) {
        pressing[i] = impulse[i] + box.velocity[i] / box.oscillators.inverse_mass();
        if (step.is_fixed(i)) {
            box.position[i] = is_at_face[i] ? faces[i] : box.position[i];
            box.velocity[i] = 0.0;
        } else {
            box.position[i] += step.way()[i];
            box.velocity[i] += impulse[i] * box.oscillators.inverse_mass();
        }
    }
    rub(box, step, pressing);
    box.time_left = 0.0;
    return is_stopped;
}

} // namespace hapnet::scene
