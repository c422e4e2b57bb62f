// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/replay/hand_trace.hpp"
#include "device/simulated/operator.hpp"
#include "device/simulated/press_schedule.hpp"
#include "device/simulated/task.hpp"

#include <memory>
#include <optional>
#include <utility>

namespace hapnet::device {

/// The intention of a hand: its position, whether it grips, the force with which it presses, and
/// whether it searches for a body that it does not feel.
struct Intention {
    base::Position target;
    bool gripping = false;
    std::optional<double> pressing_n{}; // nullopt: the task asks for no force
    bool searching = false;             // the task intends to touch a body that may be elsewhere
};

/// One hand's part in a task: a pure function of time.
class Script {
public:
    /// The stiffness of `hand` determines how far it has to aim into the cube to press with the
    /// intended force.
    Script(Task task, const Cue& cue, const TaskOptions& options = {},
           const HandImpedance& hand = {});

    /// Follows this path, of at least one moment, instead of the task's.
    void follow(std::shared_ptr<const HandTrace> way) { way_ = std::move(way); }

    [[nodiscard]] Intention at(base::TimePoint now) const;

    /// Returns the x of the path from its rest position to its part, clear of a cube at its initial
    /// position.
    [[nodiscard]] double aside_x() const;
    /// Returns +1 if the hand presses toward +x, -1 if it presses toward -x.
    [[nodiscard]] double pressing_toward() const;

private:
    /// Returns the intention at time `t` of the task, in s from its start, while the hands are on.
    [[nodiscard]] Intention working(double t) const;
    /// Returns this hand's share of the pushing, from 0 to 1.
    [[nodiscard]] double turn_share(double t) const;
    [[nodiscard]] double turn_x(double t) const;
    [[nodiscard]] double press_x(double t) const;
    [[nodiscard]] double carry_x(double t) const;
    [[nodiscard]] Intention lift(double t) const;
    [[nodiscard]] Intention wall(double t) const;
    [[nodiscard]] double tap_x(double t) const;
    [[nodiscard]] Intention turn(double t) const;
    [[nodiscard]] Intention watch() const;
    [[nodiscard]] double squeeze_n() const;
    /// Returns the depth within the face at which the hand aims in order to press with this force.
    [[nodiscard]] double depth_m(double force_n) const;

    Task task_;
    Cue cue_;
    TaskOptions options_;
    std::array<PressInterval, 6> presses_;
    double side_; // -1: left of the cube, +1: right
    double depth_m_per_n_;
    std::shared_ptr<const HandTrace> way_;
};

} // namespace hapnet::device
