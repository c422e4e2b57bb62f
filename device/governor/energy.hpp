// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <chrono>
#include <cstddef>

namespace hapnet::device {

/// Limits of the energy that the motors give to a hand in excess of the energy that the hand gives
/// to them. Both are above 0.
struct EnergyLimits {
    double power_max_w = 0.46;
    double work_max_j = 0.15; // net work within any 5 s: 30 mW on average

    friend bool operator==(const EnergyLimits&, const EnergyLimits&) = default;
};
constexpr auto fields_of(base::Tag<EnergyLimits> /*struct*/)
{
    return base::fields("energy",
                        base::field("power_max", &EnergyLimits::power_max_w,
                                    base::Quantity{base::power_kind, 1e-3, 100.0},
                                    "greatest power of the motors into the hand"),
                        base::field("work_max", &EnergyLimits::work_max_j,
                                    base::Quantity{base::energy_kind, 1e-3, 100.0},
                                    "greatest work of the motors on the hand in any 5 s, the "
                                    "hand's own work on them subtracted"));
}

/// The work between motors and hand. Work into the hand is positive.
struct EnergyFigures {
    double net_j = 0.0;
    double net_max_j = 0.0; // 0 for a passive device
    double work_5s_max_j = 0.0;
    double power_max_w = 0.0;
};
constexpr auto fields_of(base::Tag<EnergyFigures>)
{
    using E = EnergyFigures;
    return base::fields(
        "energy figures",
        base::member("net_j", &E::net_j,
                     "Work of the motors on the hand since the start, less the hand's on them."),
        base::member("net_max_j", &E::net_max_j, "The largest value that it had."),
        base::member("work_5s_max_j", &E::work_5s_max_j, "The most net work within 5 s."),
        base::member("power_max_w", &E::power_max_w, "The highest mean power of 5 ms."));
}

/// Observes the energy that a device gives to its hand, and reduces a force that would give too
/// much: a passivity observer and controller in the time domain (B. Hannaford, J.-H. Ryu:
/// Time-domain passivity control of haptic interfaces, IEEE Trans. Robotics and Automation 18,
/// 2002). The copy of a scene is passive, so energy that a hand gets in excess of what it put in
/// came from the other side. The controller only reduces forces: it limits the part of the force
/// along the hand's motion, and removes that part completely when the permitted work is used up. A
/// force against the motion passes, because it takes energy out.
class EnergyGuard {
public:
    /// `tick`: the usual time between two calls of pass().
    EnergyGuard(const EnergyLimits& limits, base::Duration tick);

    /// Accounts for a force that was held for `duration` while the hand moved to `hip`. Both are in
    /// the device's frame.
    void pass(const base::Force& held, const base::Position& hip, base::Duration duration);
    /// Call this when the device does not report where the hand is. The next position is then not
    /// compared with the last one.
    void lose_place() { placed_ = false; }

    /// Returns the permitted part of the next force while the device reports this velocity.
    [[nodiscard]] base::Force allow(const base::Force& wanted, const base::Velocity& reported);

    [[nodiscard]] const EnergyFigures& figures() const { return figures_; }

    /// The mass of the lightest hand for which the limit of the power is kept, and the lag of a
    /// velocity that was measured over 5 ms behind the next tick: a force makes the hand faster
    /// during that time.
    static constexpr double hand_kg = 0.2;
    static constexpr double behind_s = 0.003;
    /// The time over which the remaining work is distributed, so that the force has no step when
    /// the work is used up.
    static constexpr double reserve_s = 0.005;

private:
    struct Step {
        base::Displacement moved{};
        double seconds = 0.0;
        double work_j = 0.0;
    };
    /// The length of a piece, for each of which the lowest net_j is kept. All pieces together cover
    /// 5 s.
    static constexpr base::Duration piece{std::chrono::milliseconds{50}};
    static constexpr std::size_t pieces = 100;
    static constexpr std::size_t steps_max = 50;

    [[nodiscard]] double power_left_w() const;
    void add(const Step& step);
    void close_piece();
    [[nodiscard]] base::Force without_push(const base::Force& wanted, const glm::dvec3& velocity,
                                           double power_w) const;

    EnergyLimits limits_;
    EnergyFigures figures_;
    double tick_s_;
    bool placed_ = false;
    base::Position hip_;

    std::array<Step, steps_max> steps_{}; // ring of the last `steps_used_` steps: 5 ms
    std::size_t steps_used_;
    std::size_t next_step_ = 0;
    Step lately_; // sum of the steps in the ring

    std::array<double, pieces> lowest_{};
    std::size_t next_piece_ = 0;
    base::Duration into_piece_{};
    double lowest_now_j_ = 0.0;    // lowest net_j of the current piece
    double lowest_before_j_ = 0.0; // lowest net_j of the earlier pieces
};

} // namespace hapnet::device
