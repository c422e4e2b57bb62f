// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/one_box/step.hpp"
#include "scene/requirements.hpp"
#include "scene/rigid/free_flight.hpp"
#include "scene/rigid/step.hpp"

#include <variant>

namespace hapnet::scene {

/// The tick of a world: one of the profiles, chosen when the scene is frozen. Each is a value with
/// two verbs: tick(frozen, stage) and disturbed(stage, body), which says that a body was put
/// somewhere from outside. The order is that of Profile.
using Ticks =
    std::variant<FlightTick, SlidingTick<false>, SlidingTick<true>, LoneTick, FewTick, ManyTick>;

[[nodiscard]] Ticks make_ticks(Profile profile, const Description& description,
                               const Frozen& frozen, const Stage& stage);

} // namespace hapnet::scene
