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

/// A simulated person who plays a part of a task: what the hand means to do at a time, and how it
/// answers what it feels. At a fault of the device the hand stays where it is, without pressing,
/// and presses the primary button every two seconds until the fault is over; then it goes back to
/// its part. Not a human being: a script, a wavering will and reflexes. P1 is a
/// prescribed path: there the hand neither wavers nor reacts.
class Person {
public:
    explicit Person(const Role& role);

    /// Takes the session's start. `rest` is the place where the hand is.
    void on_cue(const Cue& cue, const glm::dvec3& rest);

    /// A fault of the device was latched, or has ended.
    void on_fault(bool is_latched);

    /// The hand's intention, and the error of its force.
    struct Aim {
        Intention intention;
        double force_share = 0.0;
        std::optional<double> searched_x{}; // the task's x while the hand searches; else nullopt
    };
    /// The hand's intention at `now`. The way to its part begins with the first call after the cue.
    [[nodiscard]] Aim aim(base::TimePoint now);

    /// Its perception: the deviation from its intention, and the device's force.
    struct Feedback {
        glm::dvec3 deviation{0.0};
        glm::dvec3 force{0.0};
    };
    /// The target that it pulls to then, and its force besides its own impedance's.
    struct Effort {
        base::Position target;
        glm::dvec3 force{0.0};
    };
    /// Once per aim().
    [[nodiscard]] Effort effort(const Aim& aim, const Feedback& feedback, base::TimePoint now,
                                base::Duration elapsed);

    [[nodiscard]] const HandImpedance& hand() const { return role_.person.hand; }

private:
    /// The pause from a fault to the return to the hand's part.
    struct Pause {
        bool is_over = false;
        base::Position place{};                 // where the hand stays
        std::optional<base::TimePoint> since{}; // start; nullopt: with the next aim()
        std::optional<base::TimePoint> left{};  // start of the way back to the part
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
