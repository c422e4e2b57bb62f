// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/virtual_time/setting.hpp"
#include "lab/virtual_time/trace.hpp"
#include "proto/base/result.hpp"

#include <atomic>

namespace hapnet::lab::virtual_time {

/// Plays a valid setting with all hands in one scene, as if the people sat at one computer. Each
/// tick reads all devices, advances the scene by one tick, and gives each hand its contact force.
/// There is no network and no algorithm. Every side of the trace has the same bodies. Fails when
/// `stop` became true meanwhile.
[[nodiscard]] base::Result<Trace> play_in_one_world(const Setting& setting,
                                                    const std::atomic<bool>* stop);

} // namespace hapnet::lab::virtual_time
