// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/verify/states.hpp"

#include "emulator/tools/verify/tails.hpp"
#include "proto/base/ensure.hpp"

#include <cstddef>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator::tools {

namespace {

/// Tests `count` of the `of` datagrams that were in a state.
TestResult frequency(std::string name, std::uint64_t count, std::uint64_t of, double expected,
                     double alpha)
{
    if (of == 0) return unable(std::move(name), "the chain was never in this state");
    auto result = by_chance(std::move(name), static_cast<double>(count),
                            binomial_two_sided(count, of, expected), alpha);
    result.sentence =
        fmt::format("{:.4f} % expected, {:.4f} % of {} datagrams in this state", 100.0 * expected,
                    100.0 * static_cast<double>(count) / static_cast<double>(of), of);
    return result;
}

} // namespace

TestResult test_step(const StateStep& step, std::span<const LossState> states, double alpha)
{
    std::uint64_t from = 0;
    std::uint64_t both = 0;
    for (std::size_t i = 0; i + 1 < states.size(); ++i) {
        // A datagram without a state interrupts the chain.
        if (states[i] != step.from || states[i + 1] == LossState::none) continue;
        ++from;
        if (states[i + 1] == step.to) ++both;
    }
    return frequency(fmt::format("{} to {}", to_text(step.from), to_text(step.to)), both, from,
                     step.probability, alpha);
}

TestResult test_losses_in_state(const LossesInState& losses, std::span<const LossState> states,
                                std::span<const std::uint8_t> lost, double alpha)
{
    base::ensure(states.size() == lost.size());
    std::uint64_t seen = 0;
    std::uint64_t gone = 0;
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (states[i] != losses.state) continue;
        ++seen;
        gone += lost[i];
    }
    return frequency(fmt::format("lost while {}", to_text(losses.state)), gone, seen, losses.share,
                     alpha);
}

} // namespace hapnet::emulator::tools
