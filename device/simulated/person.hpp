// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/simulated/hand_noise.hpp"
#include "device/simulated/operator.hpp"
#include "device/simulated/reactions.hpp"
#include "device/simulated/script.hpp"

#include <memory>
#include <optional>

namespace hapnet::device {

/// A part in a task.
struct Role {
    Task task = Task::p1;
    TaskOptions options{};
    Operator person{};
    std::shared_ptr<const HandTrace> way{}; // path that the person follows instead of the task's
};

/// A simulated person who plays a part of a task: the intention of the hand at a time, and its
/// response to what it feels. At a fault of the device the hand stays where it is, without
/// pressing, and presses the primary button every two seconds until the fault is over; then it
/// returns to its part. Not a human being: a script, a wavering will and reflexes. P1 is a
/// prescribed path, on which the hand neither wavers nor reacts.
class Person {
public:
    explicit Person(const Role& role);

    /// Takes the session's start. `rest` is the position of the hand.
    void on_cue(const Cue& cue, const glm::dvec3& rest);

    /// Notes that a fault of the device was latched, or has ended.
    void on_fault(bool is_latched);

    /// The hand's intention, and the error of its force.
    struct Aim {
        Intention intention;
        double force_share = 0.0;
        std::optional<double> searched_x{}; // the task's x while the hand searches; else nullopt
    };
    /// Returns the hand's intention at `now`. The movement to its part begins with the first call
    /// after the cue.
    [[nodiscard]] Aim aim(base::TimePoint now);

    /// The person's perception: the deviation from the intention, and the device's force.
    struct Feedback {
        glm::dvec3 deviation{0.0};
        glm::dvec3 force{0.0};
    };
    /// The target toward which the hand then pulls, and the force in addition to that of its
    /// impedance.
    struct Effort {
        base::Position target;
        glm::dvec3 force{0.0};
    };
    /// Returns the effort of the hand. Call it once per aim().
    [[nodiscard]] Effort effort(const Aim& aim, const Feedback& feedback, base::TimePoint now,
                                base::Duration elapsed);

    [[nodiscard]] const HandImpedance& hand() const { return role_.person.hand; }

private:
    /// The pause from a fault to the return to the hand's part.
    struct Pause {
        bool is_over = false;
        base::Position place{};                 // where the hand stays
        std::optional<base::TimePoint> since{}; // start; nullopt: with the next aim()
        std::optional<base::TimePoint> left{};  // start of the return to the part
    };
    [[nodiscard]] Aim aim_of_part(base::TimePoint now);
    [[nodiscard]] Aim paused(const Aim& aim, base::TimePoint now);

    struct Part {
        Script script;
        HandNoise noise;
        base::TimePoint start;
        bool is_prescribed;
    };

    Role role_;
    Reactions reactions_;
    std::optional<Part> part_;
    std::optional<base::TimePoint> cued_at_;
    glm::dvec3 rest_{0.0, 0.0, 0.035}; // where the hand was before its cue
    std::optional<Pause> pause_;
    base::Position meant_{{0.0, 0.0, 0.035}}; // target of the last aim()
};

} // namespace hapnet::device
