// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/simulated/operator.hpp"
#include "device/simulated/task.hpp"
#include "emulator/core/profile/profile.hpp"
#include "peer/core/scene/description.hpp"
#include "peer/core/sync/algorithm.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <chrono>

namespace hapnet::lab {

/// One side of a session in virtual time.
struct PlayerSetting {
    peer::Algorithm algorithm{};
    device::Operator person{};
    base::Duration clock_ahead{}; // of the world's time
    base::Duration phase{};       // of its ticks, 0 to less than a tick
};

/// All that a session in virtual time follows from: equal settings, equal bits.
struct Setting {
    device::Task task = device::Task::p1;
    scene::Description scene = scene::paper_scene();
    base::Seed seed{42};
    base::Duration length{std::chrono::seconds{30}}; // hands off included
    base::Duration tick{std::chrono::milliseconds{1}};
    emulator::Profile profile{}; // conditions both ways, and their timeline
    std::array<PlayerSetting, 2> players{};
};

} // namespace hapnet::lab
