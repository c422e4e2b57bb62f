// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/solver/block.hpp"

namespace hapnet::scene {

// What solving a block takes, worked out once and kept in it: they need its matrix.

/// Of one or two points' normal speeds, then of friction's: from impulses there to velocities.
[[nodiscard]] const Ldl<5>& few_factors(ContactBlock& block, const PointSet& set);

/// Of the whole matrix.
[[nodiscard]] const Ldl<6>& whole_factors(ContactBlock& block);

/// Of three or four points.
[[nodiscard]] const PlaneFit& fit_of(ContactBlock& block, const PointSet& set);

/// Of points on a line the outermost two, which say everything.
[[nodiscard]] PointSet outermost(const ContactBlock& block, const PlaneFit& fit);

/// The largest answer of the slip to friction: no step of one over it overshoots.
[[nodiscard]] double slip_answer(const ContactBlock& block);

} // namespace hapnet::scene
