// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/rigid/integrate.hpp"
#include "scene/solver/contact_solver.hpp"

#include <span>

namespace hapnet::scene {

/// Lets bodies bounce at the moment within the tick at which they hit each other, when they do so
/// fast enough to be seen. `integrations` by solver index. One hit of each contact per tick; of
/// several contacts of a body, one after the other.
void apply_restitution(ContactSolver& solver, std::span<BodyIntegration> integrations,
                       const Scales& scales);

} // namespace hapnet::scene
