// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/figures/counters.hpp"

#include <cstdint>
#include <gtest/gtest.h>

namespace hapnet::base {
namespace counters_test {

enum class Side : std::uint8_t { left, right };
constexpr auto names_of(Tag<Side>) { return names("left", "right"); }

struct Counts {
    std::uint64_t all = 0;
    std::uint64_t waiting = 0; // may decrease
    ByName<Side, std::uint64_t> by_side{};

    friend bool operator==(const Counts&, const Counts&) = default;
};
constexpr auto fields_of(Tag<Counts>)
{
    return fields("counts", member("all", &Counts::all).counter("all"),
                  member("waiting", &Counts::waiting).gauge("waiting"),
                  member("by_side", &Counts::by_side).counter("by_side", "side"));
}

namespace {

TEST(Counters, AddUp)
{
    Counts sum{5, 1, {{3, 2}}};
    add_counts(sum, Counts{10, 4, {{1, 9}}});
    EXPECT_EQ(sum, (Counts{15, 5, {{4, 11}}}));
}

TEST(Counters, SinceATimeAreDifferencesButForWhatMayFall)
{
    const Counts before{5, 8, {{3, 2}}};
    EXPECT_EQ(counted_since(Counts{15, 2, {{4, 11}}}, before), (Counts{10, 2, {{1, 9}}}));
}

} // namespace
} // namespace counters_test
} // namespace hapnet::base
