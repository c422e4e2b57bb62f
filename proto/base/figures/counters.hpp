// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/value_kind.hpp"

#include <cstddef>
#include <cstdint>

namespace hapnet::base {

// Functions for described structs whose members are counts: std::uint64_t, or one count for each
// value of an enum.

namespace detail {

template <typename Change>
void change_count(std::uint64_t& count, std::uint64_t other, const Change& change)
{
    change(count, other);
}

template <Named Enum, typename Change>
void change_count(ByName<Enum, std::uint64_t>& counts, const ByName<Enum, std::uint64_t>& others,
                  const Change& change)
{
    for (std::size_t i = 0; i < counts.values.size(); ++i) {
        change(counts.values[i], others.values[i]);
    }
}

} // namespace detail

/// Adds each count of `more` to the same count of `sum`.
template <Described T>
void add_counts(T& sum, const T& more)
{
    for_each_field(
        [](const auto& /*field*/, auto& count, const auto& other) {
            detail::change_count(count, other, [](auto& own, auto add) { own += add; });
        },
        sum, more);
}

/// Returns the counts since the earlier state `before`. Values that can fall keep their present
/// value.
template <Described T>
[[nodiscard]] T counted_since(T now, const T& before)
{
    for_each_field(
        [](const auto& field, auto& count, const auto& other) {
            if (!field.telling.metric.is_counter) return;
            detail::change_count(count, other, [](auto& own, auto minus) { own -= minus; });
        },
        now, before);
    return now;
}

} // namespace hapnet::base
