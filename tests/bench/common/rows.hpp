// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/host.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::bench {

/// The side of a target that is good.
enum class Direction : std::uint8_t { at_least, at_most };

/// A number, the baseline that it is compared with, and its target.
struct Row {
    std::string name;     // name of the case: "1 kpps, 10 ms, real-time"
    std::string subject;  // "hapnet-emulator precise"
    std::string baseline; // "": there is no baseline
    std::string metric;   // with its unit: "p50_us"; "p50_ratio": the target is for the ratio
    double value = 0.0;
    std::optional<double> baseline_value;
    std::optional<double> target;
    Direction direction = Direction::at_most;

    /// baseline_value / value; nullopt without a baseline, or when value is 0.
    [[nodiscard]] std::optional<double> ratio() const;
    /// nullopt when there is no target.
    [[nodiscard]] std::optional<bool> met() const;
};

/// Appends rows.
inline void append(std::vector<Row>& rows, const std::vector<Row>& more)
{
    rows.insert(rows.end(), more.begin(), more.end());
}

/// {"host": {...}, "rows": [...]}: the format of every benchmark of the project.
[[nodiscard]] std::string rows_json(const Host& host, std::span<const Row> rows);

/// The rows as lines of text, those with a target marked as met or MISSED.
[[nodiscard]] std::string rows_table(std::span<const Row> rows);

} // namespace hapnet::bench
