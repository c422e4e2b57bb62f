// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace hapnet::base {

/// The number, sum and maximum of whole numbers: the lengths of runs, for example.
struct Tally {
    std::uint64_t count = 0;
    std::uint64_t sum = 0;
    std::uint64_t max = 0;

    void add(std::uint64_t value)
    {
        ++count;
        sum += value;
        max = std::max(max, value);
    }

    /// Returns nullopt when nothing was added.
    [[nodiscard]] std::optional<double> mean() const
    {
        if (count == 0) return std::nullopt;
        return static_cast<double>(sum) / static_cast<double>(count);
    }

    friend bool operator==(const Tally&, const Tally&) = default;
};
constexpr auto fields_of(Tag<Tally>)
{
    return fields("tally", member("count", &Tally::count),
                  computed<Tally>("mean", [](const Tally& tally) { return tally.mean(); }),
                  member("max", &Tally::max));
}

} // namespace hapnet::base
