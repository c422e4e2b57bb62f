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
/// somewhere from outside. The order is that of StepperKind.
using Stepper = std::variant<FreeFlightStepper, OneBoxStepper<false>, OneBoxStepper<true>,
                             RigidStepper<BroadPhase::none>, RigidStepper<BroadPhase::all_pairs>,
                             RigidStepper<BroadPhase::grid>>;

[[nodiscard]] Stepper make_stepper(StepperKind kind, const Description& description,
                                   const WorldConfig& config, const WorldState& state);

} // namespace hapnet::scene
