// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"

#include <cstdint>
#include <string_view>

namespace hapnet::lab::results {

// Verdicts on results: cells of their tables.

/// The comparison of a result with the paper's claim. Undecided: the result's interval contains an
/// edge of the range of agreement.
enum class Claim : std::uint8_t { none, calibrated, met, missed, undecided };
constexpr auto names_of(base::Tag<Claim>)
{
    return base::names("", "calibrated", "met", "missed", "undecided");
}

/// The origin of a number that is compared with one of the paper's.
enum class Provenance : std::uint8_t {
    none,            // no number of the paper to compare with
    calibrated,      // fitted to the paper's number
    selected,        // follows from a reading of the paper chosen with a look at its number
    by_construction, // equal to another result by design
    predicted,       // the paper's number had no part in it
};
constexpr auto names_of(base::Tag<Provenance>)
{
    return base::names("", "calibrated", "selected", "by-construction", "predicted");
}

/// The status of a limit: its provenance and its verdict at once.
enum class LimitStatus : std::uint8_t {
    none,
    calibrated,
    calibrated_missed,
    selected_met,
    selected_missed,
    by_construction_met,
    by_construction_missed,
    predicted_met,
    predicted_missed,
    undecided,
};
constexpr auto names_of(base::Tag<LimitStatus>)
{
    return base::names("", "calibrated", "calibrated-missed", "selected-met", "selected-missed",
                       "by-construction-met", "by-construction-missed", "predicted-met",
                       "predicted-missed", "undecided");
}
/// The kind of a limit. found: there is a limit; open: less than half fail at the highest level
/// that was tried; none: half fail without any impairment.
enum class Bound : std::uint8_t { found, open, none };
constexpr auto names_of(base::Tag<Bound>) { return base::names("=", ">", "none"); }

/// The row of limits.csv with the limit of the worst task.
inline constexpr std::string_view worst_task = "worst";

} // namespace hapnet::lab::results
