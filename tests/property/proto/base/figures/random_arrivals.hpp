// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hapnet::base {

struct RandomArrival {
    std::uint64_t number = 0;
    TimePoint sent{};
    TimePoint arrived{};
};

/// A stream of one datagram a millisecond, numbered from `first`, in the order of arrival. Times
/// are whole milliseconds. The seed draws how many datagrams are lost, copied and delayed, and one
/// in four streams has outages of up to 3 s.
inline std::vector<RandomArrival> random_arrivals(std::uint64_t seed, std::uint64_t first)
{
    using Milliseconds = std::chrono::milliseconds;
    const RandomStream draw = Seed{seed}.stream("arrivals");
    const double loss = 0.6 * draw.uniform(0, 1);
    const double copies = 0.4 * draw.uniform(0, 2);
    const auto delays = static_cast<std::uint32_t>(1 + draw.below(60, 0, 3));
    const std::uint64_t count = 1 + draw.below(900, 0, 4);
    std::vector<RandomArrival> arrivals;
    std::uint64_t number = first;
    for (std::uint64_t i = 1; i <= count; ++i) {
        const bool is_outage = seed % 4 == 0 && draw.uniform(i, 1) < 0.005;
        number += is_outage ? draw.below(3000, i, 2) : 1;
        if (draw.uniform(i, 3) < loss) continue;
        const TimePoint sent = TimePoint{} + Milliseconds{number};
        const auto arrive = [&](std::uint32_t purpose) {
            arrivals.push_back(
                {number - 1, sent, sent + Milliseconds{draw.below(delays, i, purpose)}});
        };
        arrive(4);
        if (draw.uniform(i, 5) < copies) arrive(6);
        if (draw.uniform(i, 7) < copies) arrive(8);
    }
    std::ranges::stable_sort(arrivals, {}, &RandomArrival::arrived);
    return arrivals;
}

/// The first arrival of each number.
inline std::vector<RandomArrival> without_copies(const std::vector<RandomArrival>& arrivals)
{
    std::vector<RandomArrival> firsts;
    for (std::size_t i = 0; i < arrivals.size(); ++i) {
        const auto is_same = [&](const RandomArrival& one) {
            return one.number == arrivals[i].number;
        };
        const auto here = arrivals.begin() + static_cast<std::ptrdiff_t>(i);
        if (std::none_of(arrivals.begin(), here, is_same)) firsts.push_back(arrivals[i]);
    }
    return firsts;
}

/// True if none of the arrivals before this one has a higher number.
inline bool is_in_order(const std::vector<RandomArrival>& arrivals, std::size_t place)
{
    const auto here = arrivals.begin() + static_cast<std::ptrdiff_t>(place);
    return std::none_of(arrivals.begin(), here, [&](const RandomArrival& one) {
        return one.number > arrivals[place].number;
    });
}

} // namespace hapnet::base
