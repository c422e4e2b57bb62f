// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/replay/hand_trace.hpp"
#include "device/simulated/operator.hpp"
#include "device/simulated/task.hpp"
#include "device/simulated/task_options.hpp"
#include "emulator/core/profile/profile.hpp"
#include "peer/core/sync/algorithm.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "scene/description.hpp"

#include <array>
#include <chrono>
#include <memory>
#include <optional>

namespace hapnet::lab::virtual_time {

/// One side of a session in virtual time.
struct PlayerSetting {
    peer::Algorithm algorithm{};
    device::Operator person{};
    std::shared_ptr<const device::HandTrace> replay{}; // plays instead of the person; at least one
                                                       // moment, in the order of time
    base::Duration clock_ahead{};                      // of the world's time
    base::Duration phase{};                            // of its ticks, 0 to less than a tick
    /// The seed that it offers for the hands, as `hapnet-peer --seed` does; L's counts. nullopt:
    /// the setting's.
    std::optional<base::Seed> seed{};
    /// It seals its messages with the keys of this circle, which follow from the seed; with another
    /// circle's nobody is met. nullopt: without a key.
    std::optional<base::Seed> circle{};
};

/// All that a session in virtual time follows from: equal settings, equal bits.
struct Setting {
    device::Task task = device::Task::p1;
    device::TaskOptions task_options{};
    scene::Description scene = scene::paper_scene();
    base::Seed seed{42}; // of the links, whatever the profile says, and of the hands
    base::Duration length{std::chrono::seconds{30}}; // hands off included
    base::Duration tick{std::chrono::milliseconds{1}};
    emulator::Profile profile{}; // conditions both ways; its timeline counts from the first hello
    bool energy_limit = false;   // the energy into the hands is limited as the daemons do it
    std::array<PlayerSetting, 2> players{}; // 0: L, with the lower id; up is from L to R
};

/// An error when no session can be played with this setting; its message says what to do.
[[nodiscard]] base::Result<void> validate(const Setting& setting);

} // namespace hapnet::lab::virtual_time
