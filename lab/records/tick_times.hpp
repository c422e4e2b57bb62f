// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/record/reader.hpp"

#include <vector>

namespace hapnet::lab::records {

/// Returns the times at which the ticks of a peer were due, counted from the start of a session, on
/// the clock of the record. So a session in virtual time can tick in the same way. A tick that was
/// late by a tick or more gets the time at which it ran, and missed ticks are left out. Smaller
/// lateness is ignored. It delays sending as well as reading, and datagrams in virtual time take no
/// time except on the link, so some would be read a tick too early.
[[nodiscard]] std::vector<base::Duration> tick_times(const record::Record& record,
                                                     base::TimePoint start);

} // namespace hapnet::lab::records
