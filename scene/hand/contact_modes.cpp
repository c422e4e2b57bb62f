// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/contact_modes.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

/// A trajectory at a moment, with its integrals from the start.
struct TrajectoryIntegrals {
    TrajectoryPoint motion;
    double once = 0.0;  // the integral of the displacement
    double twice = 0.0; // the integral of `once`
};

TrajectoryIntegrals integrate_along(const Trajectory& trajectory, double time)
{
    const StepResponse r = trajectory.propagator->after(time);
    TrajectoryIntegrals passed{trajectory.at(r),
                               trajectory.speed * r.push + trajectory.push * r.ramp, 0.0};
    const Oscillator& oscillator = trajectory.propagator->oscillator;
    const double t2 = time * time;
    // The integrals follow from the equation of motion. Where the spring hardly acts, that would be
    // the difference of almost equal numbers. There four terms of Taylor's series are exact to
    // 1e-12.
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

double SpringContact::force() const
{
    switch (phase) {
    case SpringPhase::apart:
    case SpringPhase::slack: return 0.0;
    case SpringPhase::pressing: return unlimited_force();
    case SpringPhase::limited: return force_max;
    }
    return 0.0;
}

SpringPhase SpringContact::phase_due() const
{
    if (depth < 0.0 || unlimited_force() <= 0.0) return SpringPhase::apart;
    return unlimited_force() < force_max ? SpringPhase::pressing : SpringPhase::limited;
}

// Only the trajectories of the present phases are set.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
template <std::size_t count>
ContactModes<count>::ContactModes(std::array<SpringContact, count>& contacts,
                                  const Coupling& coupling, double time)
    : contacts_{contacts}, coupling_{coupling}, time_{time}
{
    // A damper that begins to act, or a normal that turns, changes the force at once. Then the
    // expected phase is over before it begins.
    for (SpringContact& contact : contacts_) {
        constexpr double rounding = 1e-9;
        const double unlimited_force = contact.unlimited_force();
        const double size = contact.stiffness * std::abs(contact.depth) +
                            contact.damping * std::abs(contact.closing);
        if (contact.phase == SpringPhase::limited &&
            unlimited_force < (1.0 - rounding) * contact.force_max)
            contact.phase = SpringPhase::pressing;
        if (contact.phase != SpringPhase::pressing) continue;
        if (unlimited_force > (1.0 + rounding) * contact.force_max)
            contact.phase = SpringPhase::limited;
        if (unlimited_force < -rounding * size) contact.phase = SpringPhase::apart;
    }
    const bool first = contacts_[0].phase == SpringPhase::pressing;
    if constexpr (count == 2) {
        const bool second = contacts_[1].phase == SpringPhase::pressing;
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
void ContactModes<count>::solve_parabolas()
{
    for (std::size_t i = 0; i < count; ++i) {
        const SpringContact& contact = contacts_[i];
        double push = contact.acceleration - coupling_.own[i] * contact.force();
        if constexpr (count == 2) push -= coupling_.mutual * contacts_[1 - i].force();
        propagators_[i] = Propagator{Oscillator{}, time_};
        trajectories_[i] = {&propagators_[i], contact.closing, push, 0.0};
        share_[i][i] = 1.0;
    }
}

template <std::size_t count>
void ContactModes<count>::solve_one(std::size_t pressing)
{
    const SpringContact& contact = contacts_[pressing];
    const double own = coupling_.own[pressing];
    double driven = contact.acceleration;
    if constexpr (count == 2) driven -= coupling_.mutual * contacts_[1 - pressing].force();
    propagators_[0] = Propagator{{own * contact.damping, own * contact.stiffness}, time_};
    trajectories_[0] = {&propagators_[0], contact.closing,
                        driven - own * contact.stiffness * contact.depth, 0.0};
    share_[pressing][0] = 1.0;
    modes_ = 1;
    start_[0] = contact.depth;
    weight_[pressing][0] = contact.stiffness;
    lag_ = contact.damping / contact.stiffness;
    is_solved_ = contact.stiffness > 0.0;
    if constexpr (count == 2) {
        // The depth of the other spring follows the oscillation in proportion to their coupling,
        // plus a parabola.
        const std::size_t idle = 1 - pressing;
        const SpringContact& other = contacts_[idle];
        const double follows = own > 0.0 ? coupling_.mutual / own : 0.0;
        propagators_[1] = Propagator{Oscillator{}, time_};
        trajectories_[1] = {
            &propagators_[1], other.closing - follows * contact.closing,
            other.acceleration - coupling_.own[idle] * other.force() - follows * driven, 0.0};
        share_[idle] = {follows, 1.0};
    }
}

template <std::size_t count>
void ContactModes<count>::solve_both()
{
    if constexpr (count == 2) {
        const std::array<double, 2> root{std::sqrt(contacts_[0].stiffness),
                                         std::sqrt(contacts_[1].stiffness)};
        lag_ = contacts_[0].damping / contacts_[0].stiffness;
        is_solved_ = root[0] > 0.0 && root[1] > 0.0 &&
                     std::abs(lag_ * contacts_[1].stiffness - contacts_[1].damping) <=
                         1e-14 * contacts_[1].damping;
        if (!is_solved_) return;

        // The coupling is symmetric in depths times the roots of the stiffnesses. One rotation
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
        start_ = into_modes(contacts_[0].depth, contacts_[1].depth);
        const auto speed = into_modes(contacts_[0].closing, contacts_[1].closing);
        const auto driven = into_modes(contacts_[0].acceleration, contacts_[1].acceleration);
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
WatchedQuantity ContactModes<count>::watch(std::size_t i, double level,
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
bool ContactModes<count>::keeps_phase(std::size_t i) const
{
    const SpringContact& contact = contacts_[i];
    if (contact.phase == SpringPhase::apart) {
        if (modes_ > 0) return false;
        const Trajectory& trajectory = trajectories_[i];
        return contact.depth +
                   time_ * (std::abs(trajectory.speed) + time_ * std::abs(trajectory.push)) <
               0.0;
    }
    if (contact.phase == SpringPhase::limited) return false;
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
    const double unlimited_force = contact.unlimited_force();
    return unlimited_force - change > 0.0 && unlimited_force + change < contact.force_max;
}

template <std::size_t count>
void ContactModes<count>::find_end(End& end, std::size_t i)
{
    if (keeps_phase(i)) return;
    const SpringContact& contact = contacts_[i];
    const auto watch_for = [&](SpringPhase then, double level, double sign) {
        const auto found =
            first_root(watch(i, level, {sign * contact.stiffness, sign * contact.damping}),
                       trajectories_, 0.0, end.time);
        if (found && *found < end.time) end = {*found, i, then};
    };
    const double pull = contact.stiffness * contact.depth;
    switch (contact.phase) {
    case SpringPhase::pressing:
        watch_for(SpringPhase::apart, pull, 1.0);
        if (contact.force_max < std::numeric_limits<double>::infinity())
            watch_for(SpringPhase::limited, contact.force_max - pull, -1.0);
        return;
    case SpringPhase::limited:
        watch_for(SpringPhase::pressing, pull - contact.force_max, 1.0);
        return;
    case SpringPhase::apart:
    case SpringPhase::slack: break;
    }
    if (contact.depth >= 0.0 && contact.unlimited_force() < 0.0) {
        watch_for(SpringPhase::pressing, -pull, -1.0);
        return;
    }
    const auto found =
        first_root(watch(i, -contact.depth, {-1.0, 0.0}), trajectories_, 0.0, end.time);
    if (found && *found < end.time) end = {*found, i, SpringPhase::pressing};
}

template <std::size_t count>
void ContactModes<count>::add_work(PhaseImpulses<count>& impulses) const
{
    for (std::size_t mode = 0; mode < modes_; ++mode) {
        const TrajectoryIntegrals p = integrate_along(trajectories_[mode], impulses.time);
        const double t = impulses.time;
        const double impulse = start_[mode] * t + p.once + lag_ * p.motion.displacement;
        const double moment = 0.5 * start_[mode] * t * t + p.twice + lag_ * p.once;
        for (std::size_t i = 0; i < count; ++i) {
            impulses.impulse[i] += weight_[i][mode] * impulse;
            impulses.moment[i] += weight_[i][mode] * moment;
        }
    }
}

template <std::size_t count>
PhaseImpulses<count> ContactModes<count>::advance()
{
    End end{.time = time_};
    for (std::size_t i = 0; i < count; ++i) find_end(end, i);

    PhaseImpulses<count> impulses{.time = end.time};
    add_work(impulses);
    std::array<TrajectoryPoint, count> passed;
    for (std::size_t j = 0; j < count; ++j) passed[j] = trajectories_[j].after(end.time);
    for (std::size_t i = 0; i < count; ++i) {
        SpringContact& contact = contacts_[i];
        if (contact.phase == SpringPhase::limited) {
            impulses.impulse[i] = contact.force_max * end.time;
            impulses.moment[i] = 0.5 * contact.force_max * end.time * end.time;
        }
        impulses.impulse[i] = std::clamp(impulses.impulse[i], 0.0, contact.force_max * end.time);
        contact.closing = 0.0;
        for (std::size_t j = 0; j < count; ++j) {
            contact.depth += share_[i][j] * passed[j].displacement;
            contact.closing += share_[i][j] * passed[j].speed;
        }
    }
    if (end.contact < count) contacts_[end.contact].phase = end.then;
    return impulses;
}

template class ContactModes<1>;
template class ContactModes<2>;

} // namespace hapnet::scene
