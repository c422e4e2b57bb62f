// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/statistics.hpp"
#include "emulator/core/stream_statistics.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// What a run knows of one direction.
struct DirectionOfRun {
    const Statistics& statistics;
    const StreamTotals* stream = nullptr; // null for the sum of several paths
    std::uint64_t strangers = 0;
    std::uint64_t overflowed = 0;
    bool has_distributions =
        false; // whether the JSON is to have whole distributions, not quantiles alone
};

/// As the statistics have it.
[[nodiscard]] nlohmann::ordered_json json_of(const DirectionOfRun& run, base::Duration budget);

/// What is against its being valid; see invalid_because().
[[nodiscard]] std::vector<std::string> reasons_against(const DirectionOfRun& run,
                                                       base::Duration budget);

/// A line for a person.
[[nodiscard]] std::string in_words(const char* title, const DirectionOfRun& run,
                                   base::Duration budget);

/// A part of a line on a terminal.
[[nodiscard]] std::string in_short(const char* title, const DirectionOfRun& run);

/// null where it is unknown.
[[nodiscard]] nlohmann::ordered_json json_in_us(std::optional<base::Duration> duration);

} // namespace hapnet::emulator
