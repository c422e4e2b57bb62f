// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/solver/contact_block.hpp"

namespace hapnet::scene {

/// True if the impulses already solve the block, to `tolerance` m/s.
[[nodiscard]] bool is_solved(const ContactBlock& block, const ContactVector& velocity,
                             double tolerance);

/// True if friction is at its limit, or nearly, and opposes a slip faster than `tolerance` m/s.
[[nodiscard]] bool is_slipping(const ContactBlock& block, const ContactVector& velocity,
                               double tolerance);

/// True if the normal impulses already solve the block, without regard to friction.
[[nodiscard]] bool normals_are_solved(const ContactBlock& block, const ContactVector& velocity,
                                      double tolerance);

/// Finds the impulses for which no point is slower than its least normal speed, none pulls, and
/// friction sticks or opposes the slip at its limit. The solution is direct where the contact
/// sticks or slides without friction, and by iterations where it slips. It needs the matrix.
/// Returns the change.
[[nodiscard]] ContactVector solve(ContactBlock& block, const ContactVector& velocity,
                                  double tolerance);

/// Approaches the result of solve() at less cost: by one iteration where the contact slips.
[[nodiscard]] ContactVector iterate(ContactBlock& block, const ContactVector& velocity,
                                    double tolerance);

/// As solve(), for the normal impulses alone. Friction is held.
[[nodiscard]] ContactVector solve_normals(ContactBlock& block, const ContactVector& velocity,
                                          double tolerance);

} // namespace hapnet::scene
