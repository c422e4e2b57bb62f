// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"

#include <cstdint>
#include <string_view>

namespace hapnet::lab::results {

// What is said of results in words: cells of their tables.

/// How a result stands to what the paper says; undecided: its interval lies across the edge of what
/// would agree.
enum class Claim : std::uint8_t { none, calibrated, met, missed, undecided };
constexpr auto names_of(base::Tag<Claim>)
{
    return base::names("", "calibrated", "met", "missed", "undecided");
}

/// How a number that stands beside one of the paper's came about.
enum class Provenance : std::uint8_t {
    none,            // the paper has nothing that it stands beside
    calibrated,      // fitted to it
    selected,        // follows from a reading chosen among several with a look at it
    by_construction, // another number again
    predicted,       // it had no part in it
};
constexpr auto names_of(base::Tag<Provenance>)
{
    return base::names("", "calibrated", "selected", "by-construction", "predicted");
}

/// Of a limit: both at once.
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
/// Whether a limit was found, nothing failed as far as was tried, or half fail without anything.
enum class Bound : std::uint8_t { found, open, none };
constexpr auto names_of(base::Tag<Bound>) { return base::names("=", ">", "none"); }

/// In limits.csv, where the limit of the worst of the tasks stands.
inline constexpr std::string_view worst_task = "worst";

} // namespace hapnet::lab::results
