// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/page/page_hand.hpp"
#include "device/replay/hand_trace.hpp"
#include "device/simulated/omni_plant.hpp"
#include "device/simulated/operator.hpp"
#include "device/simulated/task.hpp"
#include "device/simulated/task_options.hpp"
#include "emulator/core/profile/profile.hpp"
#include "peer/core/clock_policy.hpp"
#include "peer/core/send_policy.hpp"
#include "peer/core/sync/algorithm.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "scene/description.hpp"

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::lab::virtual_time {

/// One of the players of a session in virtual time.
struct PlayerSetting {
    peer::Algorithm algorithm{};
    peer::SendPolicy send{};
    peer::Playout playout = peer::Playout::none;
    peer::ClockPolicy clock{};
    device::Operator person{};
    device::OmniPlant omni{}; // the device that the person holds
    /// The recorded hand that plays instead of the person. It has at least one moment; the moments
    /// are in the order of time.
    std::shared_ptr<const device::HandTrace> replay{};
    /// The wishes of a page. The page moves the hand if there is no replay.
    std::shared_ptr<device::HandWishes> page{};
    /// The motion that the person intends, instead of that of the task; at least one moment.
    std::shared_ptr<const device::HandTrace> way{};
    base::Duration clock_ahead{}; // the player's clock minus the world's time
    base::Duration phase{};       // offset of the player's ticks, 0 to less than a tick
    /// The times of the player's ticks, counted from the session's start, ascending, as in a loop
    /// that woke late and missed ticks. The player ticks evenly before the first and after the last
    /// of them, and also if there are none.
    std::shared_ptr<const std::vector<base::Duration>> ticks{};
    /// The seed for the hands that the player offers, as `hapnet-peer --seed` does. That of the
    /// lowest id counts. nullopt: the setting's seed.
    std::optional<base::Seed> seed{};
    /// The seed of the circle. The circle's keys follow from it and seal the player's messages.
    /// Players meet only within a circle. nullopt: without a key.
    std::optional<base::Seed> circle{};
    /// True if that circle has a shared key; one of `keygen --own` has none. Equal for all players.
    bool has_shared_key = true;
};

/// All inputs of a session in virtual time. Equal settings give equal bits.
struct Setting {
    device::Task task = device::Task::p1;
    device::TaskOptions task_options{};
    scene::Description scene = scene::paper_scene();
    /// The seed of the links, whatever the profile states, and of the hands.
    base::Seed seed{42};
    base::Duration length{std::chrono::seconds{30}}; // time with hands off included
    base::Duration tick{std::chrono::milliseconds{1}};
    /// The conditions in both directions between any two players; the timeline counts from the
    /// first hello. With more than two players, the conditions for link "1-2" apply between the
    /// players with these ids.
    emulator::Profile profile{};
    /// True if all hands play in one scene, without a network, which excludes all effects of the
    /// profile and the algorithms. See in_one_world().
    bool is_one_world = false;
    bool energy_limit = false; // limits the energy into the hands as the daemons do
    /// Two to eight players, with the ids 1, 2, .... The 1st, 3rd, ... act as A, the others as B.
    /// The direction "up" is from the lower id to the higher.
    std::vector<PlayerSetting> players = std::vector<PlayerSetting>(2);
    /// The number of players, of more than two, that must hear each other before the session
    /// starts; 0: all. Others join later.
    std::size_t wait_for = 0;
};

/// Returns the setting of these hands in one scene, without a network. It is equal for all
/// algorithms, networks and clocks.
[[nodiscard]] Setting in_one_world(Setting setting);

/// Returns the names of the links of a session between this number of players, in the form of
/// `hapnet-emulator --link`: "1-2", "1-3", "2-3". With two players there is only "", the only path.
[[nodiscard]] std::vector<std::string> links_between(std::size_t players);

/// Checks a setting. Fails when no session can be played with it; the error says what to do.
[[nodiscard]] base::Result<void> validate(const Setting& setting);

} // namespace hapnet::lab::virtual_time
