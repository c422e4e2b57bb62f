// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fate.hpp"
#include "emulator/core/loss/theory.hpp"
#include "emulator/tools/verify/result.hpp"

#include <cstdint>
#include <span>

namespace hapnet::emulator::tools {

// Tests of the states of a chain: one state per datagram, without a gap.

/// Tests the number of steps of the chain from one state to another against the binomial law.
[[nodiscard]] TestResult test_step(const StateStep& step, std::span<const LossState> states,
                                   double alpha);

/// Tests the number of datagrams that were lost (1) in a state against the binomial law.
[[nodiscard]] TestResult test_losses_in_state(const LossesInState& losses,
                                              std::span<const LossState> states,
                                              std::span<const std::uint8_t> lost, double alpha);

} // namespace hapnet::emulator::tools
