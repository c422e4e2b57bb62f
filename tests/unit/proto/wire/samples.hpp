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
            .task = TaskName::from_text("P1").value()};
}

/// A state with every field in use. Its vectors are exact in single precision.
[[nodiscard]] inline State full_state()
{
    return {.session = 0x24232221,
            .sequence = 0x34333231,
            .sent = at(0x0102),
            .echo = Echo{at(0x0203), 5ns},
            .touching = true,
            .holding = true,
            .hip = {{1.0, -2.0, 0.5}},
            .hip_velocity = {{0.25, 4.0, -0.125}},
            .contact_force = {{8.0, 16.0, -1.0}},
            .body = BodyState{.body = 0x0201,
                              .position = {{0.5, 1.0, 2.0}},
                              .velocity = {{-4.0, -8.0, -16.0}},
                              .caused_displacement_nm = {1, -1, 0x0102},
                              .caused_impulse_nns = {2, -2, 0x0203}}};
}

} // namespace hapnet::wire
