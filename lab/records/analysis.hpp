// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/agreement.hpp"
#include "lab/records/loop.hpp"
#include "lab/records/path.hpp"
#include "lab/records/session.hpp"
#include "proto/base/result.hpp"
#include "proto/record/reader.hpp"

#include <string>
#include <vector>

namespace hapnet::lab::records {

/// What two records of one session say: how far the copies were apart, what the network did, how
/// well both loops kept their time, and whether the run counts.
struct Analysis {
    Agreement agreement;
    Path a_to_b;
    Path b_to_a;
    Loop a;
    Loop b;
    Clock clock;
    /// Why the run does not count, for people; empty: it does.
    std::vector<std::string> invalid_because;

    [[nodiscard]] bool valid() const { return invalid_because.empty(); }
};

/// Refuses records that cannot be compared; a run that went badly is analysed and not valid.
[[nodiscard]] base::Result<Analysis> analyse(const record::Record& a, const record::Record& b);

} // namespace hapnet::lab::records
