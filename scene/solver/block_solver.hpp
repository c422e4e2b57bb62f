// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/solver/contact_block.hpp"

namespace hapnet::scene {

/// Whether the impulses are an answer already, to `tolerance` m/s.
[[nodiscard]] bool is_solved(const ContactBlock& block, const ContactVector& velocity,
                             double tolerance);

/// Whether friction is at its limit, or nearly, and opposes a slip faster than `tolerance` m/s.
[[nodiscard]] bool is_slipping(const ContactBlock& block, const ContactVector& velocity,
                               double tolerance);

/// The same without regard to friction.
[[nodiscard]] bool normals_are_solved(const ContactBlock& block, const ContactVector& velocity,
                                      double tolerance);

/// Finds the impulses for which no point is slower than its least normal speed, none pulls, and
/// friction holds or opposes the slip at its limit: directly where the contact sticks or slides
/// without friction, by iterations where it slips. Needs the matrix. Returns the change.
[[nodiscard]] ContactVector solve(ContactBlock& block, const ContactVector& velocity,
                                  double tolerance);

/// Comes nearer to that at less cost: one iteration where it slips.
[[nodiscard]] ContactVector iterate(ContactBlock& block, const ContactVector& velocity,
                                    double tolerance);

/// The same as `solve` for the normal impulses alone, friction held.
[[nodiscard]] ContactVector solve_normals(ContactBlock& block, const ContactVector& velocity,
                                          double tolerance);

} // namespace hapnet::scene
