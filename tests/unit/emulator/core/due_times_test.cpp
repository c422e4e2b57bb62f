// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/due_times.hpp"

#include "proto/base/random.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <vector>

namespace hapnet::emulator {
namespace {

using Due = std::optional<base::TimePoint>;

base::TimePoint at(int microseconds)
{
    return base::TimePoint{std::chrono::microseconds{microseconds}};
}

TEST(DueTimes, NothingIsDueWhereThereAreNoPlaces)
{
    DueTimes times;
    times.refresh([](std::size_t) { return Due{}; });
    EXPECT_EQ(times.earliest(), std::nullopt);
    times.each_due(at(1), [](std::size_t) { FAIL(); });
}

TEST(DueTimes, AsksOnlyWhatHasBeenMarked)
{
    DueTimes times;
    const auto first = times.add();
    const auto second = times.add();
    std::vector<std::size_t> asked;
    const auto ask = [&](std::size_t number) {
        asked.push_back(number);
        return Due{at(5)};
    };
    times.refresh(ask);
    EXPECT_EQ(asked, (std::vector<std::size_t>{0, 1})) << "new ones are asked";
    asked.clear();
    second.mark();
    second.mark();
    times.refresh(ask);
    EXPECT_EQ(asked, (std::vector<std::size_t>{1}));
    EXPECT_EQ(first.number(), 0U);
}

TEST(DueTimes, TakesTheLowestFreeNumber)
{
    DueTimes times;
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(times.add().number(), i);
    times.remove(1);
    times.remove(3);
    EXPECT_EQ(times.add().number(), 1U);
    EXPECT_EQ(times.add().number(), 3U);
    EXPECT_EQ(times.add().number(), 5U);
}

/// Beside a map that is searched from its beginning.
TEST(DueTimes, AgreesWithASearchThroughAll)
{
    DueTimes times;
    std::map<std::size_t, Due> plain;
    std::map<std::size_t, DueTimes::Place> places;
    const auto drawn = base::Seed{7}.stream("due times");
    std::uint64_t draws = 0;
    const auto uniform = [&] { return drawn.uniform(draws++); };
    for (int step = 0; step < 3000; ++step) {
        const auto choice = uniform();
        if (choice < 0.1 && places.size() < 70) {
            const auto place = times.add();
            places.insert_or_assign(place.number(), place);
            plain[place.number()] = std::nullopt;
        } else if (choice < 0.15 && !places.empty()) {
            const auto gone = places.begin()->first;
            times.remove(gone);
            places.erase(gone);
            plain.erase(gone);
        } else if (!places.empty()) {
            auto one = places.lower_bound(static_cast<std::size_t>(uniform() * 70.0));
            if (one == places.end()) one = places.begin();
            const bool is_empty = uniform() < 0.2;
            plain[one->first] = is_empty ? Due{} : at(static_cast<int>(uniform() * 1e4));
            one->second.mark();
        }
        times.refresh([&](std::size_t number) { return plain.at(number); });
        Due earliest;
        std::vector<std::size_t> due;
        const auto now = at(static_cast<int>(uniform() * 1e4));
        for (const auto& [number, when] : plain) {
            earliest = base::earlier(earliest, when);
            if (base::is_due(when, now)) due.push_back(number);
        }
        ASSERT_EQ(times.earliest(), earliest);
        std::vector<std::size_t> visited;
        times.each_due(now, [&](std::size_t number) { visited.push_back(number); });
        ASSERT_EQ(visited, due);
    }
}

} // namespace
} // namespace hapnet::emulator
