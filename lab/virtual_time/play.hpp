// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/virtual_time/setting.hpp"
#include "lab/virtual_time/trace.hpp"
#include "lab/virtual_time/world.hpp"
#include "proto/base/result.hpp"

#include <atomic>
#include <cstdint>
#include <optional>

namespace hapnet::lab::virtual_time {

/// The sessions that continue with hands off, to measure how far apart the copies settle: either
/// those whose copies need time to agree again (several bodies, or one that turns), or all.
enum class PlaysOn : std::uint8_t { where_it_takes_time, always };

/// Plays a session from the first hello to its end in virtual time, on the cores that the daemons
/// run. A pure function of the setting. Fails when the scene cannot be shared, or when `stop`
/// became true meanwhile. A session that never begins gives an empty trace.
[[nodiscard]] base::Result<Trace> play(const Setting& setting,
                                       const std::atomic<bool>* stop = nullptr,
                                       PlaysOn plays_on = PlaysOn::where_it_takes_time);

/// Plays the first group of a new world to its end, for players with special devices. nullopt when
/// `stop` became true meanwhile.
[[nodiscard]] std::optional<Trace> play_out(VirtualWorld& world,
                                            const std::atomic<bool>* stop = nullptr,
                                            PlaysOn plays_on = PlaysOn::where_it_takes_time);

} // namespace hapnet::lab::virtual_time
