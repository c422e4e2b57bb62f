// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/trace.hpp"

namespace hapnet::lab::virtual_time {

namespace {

void turn(glm::dquat& from, const glm::dquat& to, double share)
{
    if (from != to) from = glm::slerp(from, to, share);
}

} // namespace

Sample between(const Sample& earlier, const Sample& later, double share)
{
    if (share == 0.0) return earlier;
    Sample sample = earlier;
    const auto go = [share](auto& from, const auto& to) { from = from + share * (to - from); };
    go(sample.body, later.body);
    go(sample.body_velocity, later.body_velocity);
    turn(sample.orientation, later.orientation, share);
    go(sample.hip, later.hip);
    go(sample.hip_velocity, later.hip_velocity);
    go(sample.on_hand, later.on_hand);
    go(sample.on_body, later.on_body);
    return sample;
}

Pose between(const Pose& earlier, const Pose& later, double share)
{
    if (share == 0.0) return earlier;
    Pose pose{earlier.position + share * (later.position - earlier.position), earlier.orientation};
    turn(pose.orientation, later.orientation, share);
    return pose;
}

} // namespace hapnet::lab::virtual_time
