// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/latin_hypercube.hpp"

#include <cstddef>
#include <numeric>
#include <utility>

namespace hapnet::base {

std::vector<double> latin_places(const RandomStream& stream, std::uint32_t points)
{
    std::vector<double> places(points);
    std::iota(places.begin(), places.end(), 0.0);
    for (std::uint32_t i = points; i > 1; --i) { // a shuffle (Fisher, Yates)
        std::swap(places[i - 1], places[static_cast<std::size_t>(stream.below(i, i - 1))]);
    }
    for (std::uint32_t i = 0; i < points; ++i) places[i] += stream.uniform(i, 1);
    return places;
}

} // namespace hapnet::base
