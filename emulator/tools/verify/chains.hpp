// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/law.hpp"
#include "emulator/core/verdict.hpp"
#include "emulator/tools/verify/result.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::emulator {

/// How often a chain went from one state to another, each against the binomial law of its
/// probability. `states`: one per datagram, without a gap. Empty for laws without states;
/// `spacing` is needed for the chain in time alone.
[[nodiscard]] std::vector<TestResult> test_steps(const LossLaw& law,
                                                 std::span<const LossState> states,
                                                 std::optional<base::Duration> spacing,
                                                 double alpha);

/// How many datagrams were lost (1) in each state of a two-state chain, likewise.
[[nodiscard]] std::vector<TestResult> test_losses_in_states(const LossLaw& law,
                                                            std::span<const LossState> states,
                                                            std::span<const std::uint8_t> lost,
                                                            double alpha);

} // namespace hapnet::emulator
