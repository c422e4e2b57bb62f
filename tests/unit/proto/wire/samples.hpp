// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/wire/message.hpp"

#include <chrono>

namespace hapnet::wire {

using namespace std::chrono_literals;

/// The moment `ns` nanoseconds after the clock's zero.
[[nodiscard]] constexpr base::TimePoint at(std::int64_t ns)
{
    return base::TimePoint{base::Duration{ns}};
}

/// A hello with every field in use.
[[nodiscard]] inline Hello full_hello()
{
    return {.nonce = 0x04030201,
            .nonce_heard = 0x14131211,
            .peer_id = 0x0201,
            .tick_rate_hz = 1000,
            .scene_hash = 0x0807060504030201,
            .seed = 0x1817161514131211,
            .sent = at(0x0102),
            .echo = Echo{at(-1), base::Duration{0xfffefdfc}},
            .start = at(0x0203),
            .start_heard = at(0x0304),
            .in_session = true,
            .task = TaskName::from_text("P1").value(),
            .length_ms = 0x00007530,
            .heard = 0x00000006,
            .boot = 0x24232221,
            .hand = {.mass = 0.5F, .damping = 1.0F, .stiffness = 2.0F, .friction = 4.0F}};
}

/// A body that cannot turn. Its vectors are exact in single precision.
[[nodiscard]] inline BodyState plain_body()
{
    return {.body = 0x0201,
            .position = {{0.5, 1.0, 2.0}},
            .velocity = {{-4.0, -8.0, -16.0}},
            .caused_displacement_um = {1, 0xffffffff, 0x0102},
            .caused_impulse_uns = {2, 0xfffffffe, 0x0203},
            .turning = {}};
}

/// A body that can turn.
[[nodiscard]] inline BodyState turning_body()
{
    BodyState body = plain_body();
    body.body = 0x0202;
    body.turning = Turning{.orientation = Orientation::from({0.0, 1.0, 0.0, 0.0}),
                           .angular_velocity = {1.0, 2.0, 4.0},
                           .caused_rotation_urad = {3, 4, 5},
                           .caused_angular_impulse_unms = {6, 7, 8}};
    return body;
}

/// A state with every field in use.
[[nodiscard]] inline State full_state()
{
    State state;
    state.session = 0x24232221;
    state.sequence = 0x34333231;
    state.sent = at(0x0102);
    state.echo = Echo{at(0x0203), 5ns};
    state.touching = true;
    state.holding = true;
    state.hip = {{1.0, -2.0, 0.5}};
    state.hip_velocity = {{0.25, 4.0, -0.125}};
    state.contact_force = {{8.0, 16.0, -1.0}};
    state.intention = {{1e-5, 1e-5 * -2, 1e-5 * 0x0102}};
    state.intention_velocity = {{2e-4, 2e-4 * -3, 2e-4 * 0x0203}};
    state.work_uj = 0x44434241;
    state.bodies.add(plain_body());
    return state;
}

} // namespace hapnet::wire
