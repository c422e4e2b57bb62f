// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/record/reader.hpp"

#include <vector>

namespace hapnet::lab::records {

/// When the ticks of a peer were due, from the start of a session on, counted from that start, on
/// the clock of the record. One that came a tick late or more counts when it came, and those that
/// were missed are not there. For a session in virtual time that ticks as this one did. Less
/// lateness is left out: it delays what is sent as well as what is read, and a session in virtual
/// time, whose datagrams take no time but the link's, would read some a tick too early.
[[nodiscard]] std::vector<base::Duration> tick_times(const record::Record& record,
                                                     base::TimePoint start);

} // namespace hapnet::lab::records
