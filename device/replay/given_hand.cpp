// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/replay/given_hand.hpp"

namespace hapnet::device {

namespace {

constexpr double peak_n = 3.3; // peak force of the Omni

} // namespace

Capabilities GivenHand::capabilities()
{
    Capabilities capabilities;
    const glm::dvec3 reach{hand_reach_max_m};
    capabilities.workspace_min = {-reach};
    capabilities.workspace_max = {reach};
    // The hand accepts any force, and does not yield, so that its session has forces to record.
    capabilities.force_max_n = peak_n;
    capabilities.force_continuous_n = peak_n;
    return capabilities;
}

Sample GivenHand::sample(const HandMoment& moment, base::TimePoint now)
{
    Sample sample;
    sample.hip = moment.hip;
    sample.velocity = velocity_.at(moment.hip, now);
    sample.gripping = moment.gripping;
    sample.docked = moment.docked;
    sample.buttons = moment.gripping ? 1 : 0;
    sample.sequence = ++reads_;
    return sample;
}

} // namespace hapnet::device
