// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/base_options.hpp"
#include "peer/core/sync/situation.hpp"

namespace hapnet::peer {

/// Plays a tick of the base algorithm for bodies that turn, and for several bodies. The rules of
/// the base algorithm apply to each group of bodies that touch each other:
/// - This hand touches one of them: all of them move by this copy's own dynamics. The force of
///   another hand acts at the place of that hand: it is a force on the body's centre, with the
///   torque that it has about the centre.
/// - Only other hands touch one of them: each body is where the lowest id of those peers has it.
/// - No hand touches one of them: they coast, and after a while the copies move to those of their
///   owners (SharedPoses).
[[nodiscard]] Outcome tick_bodies(scene::World& world, const Situation& situation,
                                  const BaseOptions& options);

} // namespace hapnet::peer
