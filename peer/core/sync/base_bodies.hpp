// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/base_options.hpp"
#include "peer/core/sync/situation.hpp"

namespace hapnet::peer {

/// A tick of the base algorithm for bodies that turn, and for several. The base algorithm's rules
/// for the body hold here for each group of bodies that touch each other:
/// - this hand touches one of them: all of them move by this copy's own dynamics. Another's force
///   acts where its hand is: on the body's centre, with the torque that it has about it;
/// - only other hands touch one of them: each is where the lowest id of those has it;
/// - no hand does: they coast, and after a while the copies go to their owner's (SharedPoses).
[[nodiscard]] Outcome tick_bodies(scene::World& world, const Situation& situation,
                                  const BaseOptions& options);

} // namespace hapnet::peer
