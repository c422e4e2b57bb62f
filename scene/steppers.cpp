// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/steppers.hpp"

namespace hapnet::scene {

Stepper make_stepper(StepperKind kind, const Description& description, const WorldConfig& config,
                     const WorldState& state)
{
    switch (kind) {
    case StepperKind::flight: return FreeFlightStepper{description, config, state};
    case StepperKind::sliding: return OneBoxStepper<false>{description, config, state};
    case StepperKind::sliding_coulomb: return OneBoxStepper<true>{description, config, state};
    case StepperKind::lone: return RigidStepper<BroadPhase::none>{description, config, state};
    case StepperKind::few: return RigidStepper<BroadPhase::all_pairs>{description, config, state};
    case StepperKind::many: break;
    }
    return RigidStepper<BroadPhase::grid>{description, config, state};
}

} // namespace hapnet::scene
