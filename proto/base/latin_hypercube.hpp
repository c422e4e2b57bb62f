// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"

#include <cstdint>
#include <vector>

namespace hapnet::base {

/// One parameter of a latin hypercube (McKay, Beckman, Conover 1979): where each of `points` points
/// lies along it, from 0 to less than `points`. Every whole part is there once, in an order that
/// the stream shuffles, with a uniform draw behind it. A stream for each parameter keeps it as it
/// is when others come or go.
[[nodiscard]] std::vector<double> latin_places(const RandomStream& stream, std::uint32_t points);

} // namespace hapnet::base
