// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"

#include <cstdint>
#include <vector>

namespace hapnet::base {

/// Returns the places of all points along one parameter of a latin hypercube (McKay, Beckman,
/// Conover 1979), each from 0 to less than `points`. Each integer part occurs once, in an order
/// that the stream shuffles. A uniform draw gives the fraction. Give each parameter its own stream,
/// so that adding or removing other parameters does not change it.
[[nodiscard]] std::vector<double> latin_places(const RandomStream& stream, std::uint32_t points);

} // namespace hapnet::base
