// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/simulated/task.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <vector>

namespace hapnet::lab::virtual_time {

/// One side in one tick: its copy of the scene, its hand and its motors.
struct Sample {
    base::Position body; // position of the shared body, after the tick
    base::Velocity body_velocity;
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0}; // orientation of the body, if it can turn
    base::Position hip;                         // haptic interface point, as the device reports it
    base::Velocity hip_velocity;
    base::Force on_hand; // force sent to the device, after the governor
    base::Force on_body; // force of this side's hand on the body
    bool touching = false;
    bool holding = false;
    bool remote_touching = false; // another side's hand touches, as far as this side knows
};

/// The position and the orientation of a body.
struct Pose {
    base::Position position;
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
};

/// The greatest distance and the greatest angle between copies of a body, after they have had time
/// to agree again.
struct Settled {
    double metres = 0.0;
    double radians = 0.0;
};

/// The sides of a session while all were running, at equal times. Sample i of each side is i ticks
/// after the first. The trace comes from virtual time or from records; metrics make no difference.
struct Trace {
    device::Task task = device::Task::p1;
    base::Duration tick{std::chrono::milliseconds{1}};
    base::Duration begin{}; // time of sample 0, from the session's start
    /// Two or more sides, equally long, in the order of their ids. The 1st, 3rd, ... act as A, the
    /// others as B.
    std::vector<std::vector<Sample>> sides = std::vector<std::vector<Sample>>(2);
    /// The poses of the further shared bodies on each side: `further_bodies` entries after each
    /// tick, in the order of their ids. Empty where there is one body.
    std::vector<std::vector<Pose>> further{};
    std::size_t further_bodies = 0;
    /// The greatest differences between the copies of each shared body, from 2 s after hands off to
    /// the end. They are measured where several bodies are shared, or one that can turn. Empty: the
    /// session was not played so far.
    std::vector<Settled> settled{};
    /// The share of the session, 0 to 1, in which all were running; hands off not counted.
    double overlap = 0.0;
    /// The traffic of the busiest direction between any two sides with the headers of UDP over
    /// IPv4, bit/s; 0 for records.
    double rate_bit_per_s = 0.0;
    base::Duration simulated{}; // virtual time played, from the first hello; 0 for records
};

/// Returns a side between two of its samples, at `share` (0 to 1), by linear interpolation. Its
/// flags are the earlier sample's. With share 0 it is the earlier sample.
[[nodiscard]] Sample between(const Sample& earlier, const Sample& later, double share);
/// Returns a body between two of its samples, in the same way.
[[nodiscard]] Pose between(const Pose& earlier, const Pose& later, double share);

} // namespace hapnet::lab::virtual_time
