// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/latin_hypercube.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace hapnet::base {

TEST(LatinHypercube, HasEachPartOnceAndADrawWithinIt)
{
    for (const std::uint32_t points : {1U, 2U, 7U, 100U}) {
        const auto places = latin_places(Seed{5}.stream("mass"), points);
        std::set<int> parts;
        bool is_even = true;
        for (const double place : places) {
            parts.insert(static_cast<int>(std::floor(place)));
            is_even = is_even && place == std::floor(place);
        }
        EXPECT_EQ(parts.size(), points);
        EXPECT_EQ(*parts.begin(), 0);
        EXPECT_EQ(*parts.rbegin(), static_cast<int>(points) - 1);
        EXPECT_FALSE(is_even);
    }
}

TEST(LatinHypercube, FollowsFromTheStreamAlone)
{
    const auto places = [](std::uint64_t seed, const char* name) {
        return latin_places(Seed{seed}.stream(name), 50);
    };
    EXPECT_EQ(places(1, "mass"), places(1, "mass"));
    EXPECT_NE(places(1, "mass"), places(2, "mass"));
    EXPECT_NE(places(1, "mass"), places(1, "damping"));
}

} // namespace hapnet::base
