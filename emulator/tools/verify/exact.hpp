// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fate.hpp"
#include "emulator/core/loss/theory.hpp"
#include "emulator/tools/verify/result.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <span>

namespace hapnet::emulator::tools {

// Tests of laws that leave nothing, or little, to chance.

/// Tests if the fates are equal, datagram by datagram, and if their numbers are equal.
[[nodiscard]] TestResult test_equal(std::span<const Fate> expected, std::span<const Fate> observed);

/// Compares expected and observed losses (1: lost) index by index, for laws that draw nothing.
[[nodiscard]] TestResult test_same_losses(std::span<const std::uint8_t> expected,
                                          std::span<const std::uint8_t> observed);

/// Tests if each whole block lost exactly its number.
[[nodiscard]] TestResult test_blocks(std::span<const std::uint8_t> lost, const ExactBlocks& law);

/// Tests if each place in a block is lost equally often: chi-square over the places.
[[nodiscard]] TestResult test_places(std::span<const std::uint8_t> lost, const ExactBlocks& law,
                                     double alpha);

/// Tests if the losses are bursts of one length that return with one period, wherever they begin.
[[nodiscard]] TestResult test_bursts(std::span<const std::uint8_t> lost,
                                     const RecurringBursts& law);

} // namespace hapnet::emulator::tools
