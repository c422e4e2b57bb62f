// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/session.hpp"
#include "lab/virtual_time/trace.hpp"

#include <span>
#include <vector>

namespace hapnet::lab::records {

/// Returns the trace of a session from two records, in the form in which play() returns it for a
/// session in virtual time. Both sides have the same even times, interpolated linearly between
/// their rows. Side 0 is the one with the lower id; its seed and clock count. The records may come
/// in either order.
///
/// Rows do not hold everything. `on_body` is the reaction to the force that the scene gave the
/// hand. It differs from the force on the body where the force on the hand was softened for
/// passivity, or where the hand touched something else, too. `holding` is false throughout. Time
/// without rows (more than 10 ms) is interpolated linearly, too, but does not count in `overlap`.
[[nodiscard]] virtual_time::Trace trace_of(const Session& session);

/// Returns the trace of more than two sides: side A of all these sessions, and the other side of
/// each. There is at least one session. The sides of the trace are sorted by their ids.
[[nodiscard]] virtual_time::Trace trace_of(std::span<const Session> sessions);

/// Returns the bodies that all sessions share, in the order in which that trace has them.
[[nodiscard]] std::vector<RecordedBody> bodies_of(std::span<const Session> sessions);

} // namespace hapnet::lab::records
