// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/pressing.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

/// A course at a moment, with its integrals from the start.
struct Passed {
    TrajectoryPoint motion;
    double once = 0.0;  // the integral of the way
    double twice = 0.0; // the integral of that
};

Passed pass_along(const Trajectory& trajectory, double time)
{
    const StepResponse r = trajectory.propagator->after(time);
    Passed passed{trajectory.at(r), trajectory.speed * r.push + trajectory.push * r.ramp, 0.0};
    const Oscillator& oscillator = trajectory.propagator->oscillator;
    const double t2 = time * time;
    // From the law itself; where it hardly acts, that would be the difference of almost equal
    // numbers, and four terms of Taylor's series are exact to 1e-12.
    constexpr double hardly = 1e-3;
    if (oscillator.stiffness * t2 > hardly || oscillator.damping * time > hardly * 100.0) {
        if (oscillator.stiffness > 0.0) {
            passed.twice = (0.5 * trajectory.push * t2 + trajectory.speed * time -
                            passed.motion.displacement - oscillator.damping * passed.once) /
                           oscillator.stiffness;
            return passed;
        }
    }
    const double acceleration = trajectory.push - oscillator.damping * trajectory.speed;
    const double jerk =
        -oscillator.damping * acceleration - oscillator.stiffness * trajectory.speed;
    const double snap = -oscillator.damping * jerk - oscillator.stiffness * acceleration;
    passed.twice = t2 * time *
                   (trajectory.speed / 6.0 +
                    time * (acceleration / 24.0 + time * (jerk / 120.0 + time * snap / 720.0)));
    return passed;
}

} // namespace

double Press::force() const
{
    switch (phase) {
    case PressPhase::apart: return 0.0;
    case PressPhase::pressing: return drive();
    case PressPhase::capped: return force_max;
    }
    return 0.0;
}

PressPhase Press::due() const
{
    if (depth < 0.0 || drive() <= 0.0) return PressPhase::apart;
    return drive() < force_max ? PressPhase::pressing : PressPhase::capped;
}

// The courses are set for the phases that there are.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
template <std::size_t count>
Presses<count>::Presses(std::array<Press, count>& presses, const Coupling& coupling, double time)
    : presses_{presses}, coupling_{coupling}, time_{time}
{
    // Where a damper begins to act, or its normal turns, its force changes at once: then the phase
    // that was foreseen is over before it begins.
    for (Press& press : presses_) {
        constexpr double rounding = 1e-9;
        const double drive = press.drive();
        const double size =
            press.stiffness * std::abs(press.depth) + press.damping * std::abs(press.closing);
        if (press.phase == PressPhase::capped && drive < (1.0 - rounding) * press.force_max)
            press.phase = PressPhase::pressing;
        if (press.phase != PressPhase::pressing) continue;
        if (drive > (1.0 + rounding) * press.force_max) press.phase = PressPhase::capped;
        if (drive < -rounding * size) press.phase = PressPhase::apart;
    }
    const bool first = presses_[0].phase == PressPhase::pressing;
    if constexpr (count == 2) {
        const bool second = presses_[1].phase == PressPhase::pressing;
        if (first && second) {
            solve_both();
            return;
        }
        if (second) {
            solve_one(1);
            return;
        }
    }
    if (first) {
        solve_one(0);
    } else {
        solve_parabolas();
    }
}

template <std::size_t count>
void Presses<count>::solve_parabolas()
{
    for (std::size_t i = 0; i < count; ++i) {
        const Press& press = presses_[i];
        double push = press.acceleration - coupling_.own[i] * press.force();
        if constexpr (count == 2) push -= coupling_.mutual * presses_[1 - i].force();
        propagators_[i] = Propagator{Oscillator{}, time_};
        trajectories_[i] = {&propagators_[i], press.closing, push, 0.0};
        share_[i][i] = 1.0;
    }
}

template <std::size_t count>
void Presses<count>::solve_one(std::size_t pressing)
{
    const Press& press = presses_[pressing];
    const double own = coupling_.own[pressing];
    double driven = press.acceleration;
    if constexpr (count == 2) driven -= coupling_.mutual * presses_[1 - pressing].force();
    propagators_[0] = Propagator{{own * press.damping, own * press.stiffness}, time_};
    trajectories_[0] = {&propagators_[0], press.closing,
                        driven - own * press.stiffness * press.depth, 0.0};
    share_[pressing][0] = 1.0;
    modes_ = 1;
    start_[0] = press.depth;
    weight_[pressing][0] = press.stiffness;
    lag_ = press.damping / press.stiffness;
    is_solved_ = press.stiffness > 0.0;
    if constexpr (count == 2) {
        // The other one's depth follows the oscillation by how much they are coupled, and is
        // carried by a parabola besides.
        const std::size_t idle = 1 - pressing;
        const Press& other = presses_[idle];
        const double follows = own > 0.0 ? coupling_.mutual / own : 0.0;
        propagators_[1] = Propagator{Oscillator{}, time_};
        trajectories_[1] = {
            &propagators_[1], other.closing - follows * press.closing,
            other.acceleration - coupling_.own[idle] * other.force() - follows * driven, 0.0};
        share_[idle] = {follows, 1.0};
    }
}

template <std::size_t count>
void Presses<count>::solve_both()
{
    if constexpr (count == 2) {
        const std::array<double, 2> root{std::sqrt(presses_[0].stiffness),
                                         std::sqrt(presses_[1].stiffness)};
        lag_ = presses_[0].damping / presses_[0].stiffness;
        is_solved_ = root[0] > 0.0 && root[1] > 0.0 &&
                     std::abs(lag_ * presses_[1].stiffness - presses_[1].damping) <=
                         1e-14 * presses_[1].damping;
        if (!is_solved_) return;

        // In depths times the roots of the stiffnesses the coupling is symmetric: one rotation
        // (after Jacobi) makes it diagonal.
        const double a = root[0] * root[0] * coupling_.own[0];
        const double b = root[1] * root[1] * coupling_.own[1];
        const double mutual = root[0] * root[1] * coupling_.mutual;
        double tangent = 0.0;
        if (mutual != 0.0) {
            const double width = 0.5 * (b - a) / mutual;
            tangent =
                std::copysign(1.0, width) / (std::abs(width) + std::sqrt(1.0 + width * width));
        }
        const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
        const double sine = tangent * cosine;
        const std::array<double, 2> strength{std::max(a - tangent * mutual, 0.0),
                                             std::max(b + tangent * mutual, 0.0)};
        // Mode 0 is cosine * first - sine * second; mode 1 is sine * first + cosine * second.
        const auto into_modes = [&](double first, double second) {
            return std::array<double, 2>{cosine * (root[0] * first) - sine * (root[1] * second),
                                         sine * (root[0] * first) + cosine * (root[1] * second)};
        };
        start_ = into_modes(presses_[0].depth, presses_[1].depth);
        const auto speed = into_modes(presses_[0].closing, presses_[1].closing);
        const auto driven = into_modes(presses_[0].acceleration, presses_[1].acceleration);
        for (const std::size_t mode : {0U, 1U}) {
            propagators_[mode] = Propagator{{strength[mode] * lag_, strength[mode]}, time_};
            trajectories_[mode] = {&propagators_[mode], speed[mode],
                                   driven[mode] - strength[mode] * start_[mode], 0.0};
        }
        share_ = {{{cosine / root[0], sine / root[0]}, {-sine / root[1], cosine / root[1]}}};
        weight_ = {{{cosine * root[0], sine * root[0]}, {-sine * root[1], cosine * root[1]}}};
        modes_ = 2;
    }
}

template <std::size_t count>
WatchedQuantity Presses<count>::watch(std::size_t i, double level,
                                      const std::array<double, 2>& weights)
{
    WatchedQuantity watch;
    watch.level = level;
    for (std::size_t trajectory = 0; trajectory < count; ++trajectory) {
        watch.displacement_weight[trajectory] = weights[0] * share_[i][trajectory];
        watch.speed_weight[trajectory] = weights[1] * share_[i][trajectory];
    }
    return watch;
}

template <std::size_t count>
bool Presses<count>::is_settled(std::size_t i) const
{
    const Press& press = presses_[i];
    if (press.phase == PressPhase::apart) {
        if (modes_ > 0) return false;
        const Trajectory& trajectory = trajectories_[i];
        return press.depth +
                   time_ * (std::abs(trajectory.speed) + time_ * std::abs(trajectory.push)) <
               0.0;
    }
    if (press.phase == PressPhase::capped) return false;
    double change = 0.0;
    for (std::size_t mode = 0; mode < modes_; ++mode) {
        const Trajectory& trajectory = trajectories_[mode];
        const Oscillator& oscillator = trajectory.propagator->oscillator;
        const double acceleration = trajectory.push - oscillator.damping * trajectory.speed;
        const double jerk =
            -oscillator.damping * acceleration - oscillator.stiffness * trajectory.speed;
        const double rate = std::abs(trajectory.speed + lag_ * acceleration);
        const double bend = std::abs(acceleration + lag_ * jerk);
        change += std::abs(weight_[i][mode]) *
                  (rate + time_ * (bend + trajectory.propagator->frequency * rate));
    }
    change *= time_;
    const double drive = press.drive();
    return drive - change > 0.0 && drive + change < press.force_max;
}

template <std::size_t count>
void Presses<count>::look(End& end, std::size_t i)
{
    if (is_settled(i)) return;
    const Press& press = presses_[i];
    const auto look_for = [&](PressPhase then, double level, double sign) {
        const auto found =
            first_root(watch(i, level, {sign * press.stiffness, sign * press.damping}),
                       trajectories_, 0.0, end.time);
        if (found && *found < end.time) end = {*found, i, then};
    };
    const double pull = press.stiffness * press.depth;
    switch (press.phase) {
    case PressPhase::pressing:
        look_for(PressPhase::apart, pull, 1.0);
        if (press.force_max < std::numeric_limits<double>::infinity())
            look_for(PressPhase::capped, press.force_max - pull, -1.0);
        return;
    case PressPhase::capped: look_for(PressPhase::pressing, pull - press.force_max, 1.0); return;
    case PressPhase::apart: break;
    }
    if (press.depth >= 0.0 && press.drive() < 0.0) {
        look_for(PressPhase::pressing, -pull, -1.0);
        return;
    }
    const auto found =
        first_root(watch(i, -press.depth, {-1.0, 0.0}), trajectories_, 0.0, end.time);
    if (found && *found < end.time) end = {*found, i, PressPhase::pressing};
}

template <std::size_t count>
void Presses<count>::add_work(Pressed<count>& pressed) const
{
    for (std::size_t mode = 0; mode < modes_; ++mode) {
        const Passed p = pass_along(trajectories_[mode], pressed.time);
        const double t = pressed.time;
        const double impulse = start_[mode] * t + p.once + lag_ * p.motion.displacement;
        const double moment = 0.5 * start_[mode] * t * t + p.twice + lag_ * p.once;
        for (std::size_t i = 0; i < count; ++i) {
            pressed.impulse[i] += weight_[i][mode] * impulse;
            pressed.moment[i] += weight_[i][mode] * moment;
        }
    }
}

template <std::size_t count>
Pressed<count> Presses<count>::pass()
{
    End end{.time = time_};
    for (std::size_t i = 0; i < count; ++i) look(end, i);

    Pressed<count> pressed{.time = end.time};
    add_work(pressed);
    std::array<TrajectoryPoint, count> passed;
    for (std::size_t j = 0; j < count; ++j) passed[j] = trajectories_[j].after(end.time);
    for (std::size_t i = 0; i < count; ++i) {
        Press& press = presses_[i];
        if (press.phase == PressPhase::capped) {
            pressed.impulse[i] = press.force_max * end.time;
            pressed.moment[i] = 0.5 * press.force_max * end.time * end.time;
        }
        pressed.impulse[i] = std::clamp(pressed.impulse[i], 0.0, press.force_max * end.time);
        press.closing = 0.0;
        for (std::size_t j = 0; j < count; ++j) {
            press.depth += share_[i][j] * passed[j].displacement;
            press.closing += share_[i][j] * passed[j].speed;
        }
    }
    if (end.press < count) presses_[end.press].phase = end.then;
    return pressed;
}

template class Presses<1>;
template class Presses<2>;

} // namespace hapnet::scene
