// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/session.hpp"
#include "lab/virtual_time/trace.hpp"

#include <span>
#include <vector>

namespace hapnet::lab::records {

/// Returns the trace of a session from two records, as play() returns it for a session in virtual
/// time: both sides at the same even times, by straight lines between their rows. Side 0 is the one
/// whose seed and clock count, the lower id; the records may come in either order.
///
/// Rows do not hold everything: `on_body` is the reaction to what the scene gave the hand, which
/// differs from the force on the body where the force on the hand was softened for passivity, or
/// where the hand touched something else besides; `holding` is false throughout. Time without rows
/// (more than 10 ms) is bridged by straight lines too, but does not count in `overlap`.
[[nodiscard]] virtual_time::Trace trace_of(const Session& session);

/// Returns the trace of more than two sides: side A of all these sessions, and the other side of
/// each. There is at least one session. The sides of the trace are in the order of their ids.
[[nodiscard]] virtual_time::Trace trace_of(std::span<const Session> sessions);

/// The bodies that all of them share, in the order in which that trace has them.
[[nodiscard]] std::vector<RecordedBody> bodies_of(std::span<const Session> sessions);

} // namespace hapnet::lab::records
