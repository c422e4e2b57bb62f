// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/verify/chains.hpp"

#include "emulator/core/loss/steps.hpp"
#include "emulator/tools/verify/tails.hpp"
#include "proto/base/ensure.hpp"

#include <array>
#include <cstddef>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

/// That of a chain whose steps can be known.
std::optional<TwoStateSteps> two_state_steps(const LossLaw& law,
                                             std::optional<base::Duration> spacing)
{
    if (const auto* gilbert = std::get_if<Gilbert>(&law)) return steps_of(*gilbert);
    if (const auto* chain = std::get_if<GilbertElliott>(&law)) return steps_of(*chain);
    const auto* timed = std::get_if<TimedGilbertElliott>(&law);
    if (timed == nullptr || !spacing) return std::nullopt;
    return steps_of(*timed, *spacing);
}

/// How often each state was followed by each.
class StepCounts {
public:
    explicit StepCounts(std::span<const LossState> states)
    {
        for (std::size_t i = 0; i + 1 < states.size(); ++i) {
            ++counts_[index(states[i])][index(states[i + 1])];
        }
    }

    [[nodiscard]] std::uint64_t of(LossState from, LossState to) const
    {
        return counts_[index(from)][index(to)];
    }

    [[nodiscard]] std::uint64_t from(LossState state) const
    {
        std::uint64_t sum = 0;
        for (const auto count : counts_[index(state)]) sum += count;
        return sum;
    }

private:
    static constexpr std::size_t states_count = 7;
    static std::size_t index(LossState state) { return static_cast<std::size_t>(state); }

    std::array<std::array<std::uint64_t, states_count>, states_count> counts_{};
};

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

struct Step {
    LossState from;
    LossState to;
    double probability;
};

std::vector<Step> steps_to_test(const LossLaw& law, std::optional<base::Duration> spacing)
{
    if (const auto two = two_state_steps(law, spacing)) {
        return {{LossState::good, LossState::bad, two->good_to_bad},
                {LossState::bad, LossState::good, two->bad_to_good}};
    }
    const auto* four = std::get_if<FourState>(&law);
    if (four == nullptr) return {};
    const auto steps = steps_of(*four);
    return {{LossState::received_in_gap, LossState::lost_in_burst, steps.gap_to_burst},
            {LossState::received_in_gap, LossState::lost_in_gap, steps.gap_to_isolated},
            {LossState::lost_in_burst, LossState::received_in_gap, steps.burst_to_gap},
            {LossState::lost_in_burst, LossState::received_in_burst, steps.burst_to_good_run},
            {LossState::received_in_burst, LossState::lost_in_burst, steps.good_run_to_burst},
            {LossState::lost_in_gap, LossState::received_in_gap, 1.0}};
}

} // namespace

std::vector<TestResult> test_steps(const LossLaw& law, std::span<const LossState> states,
                                   std::optional<base::Duration> spacing, double alpha)
{
    const StepCounts counts{states};
    std::vector<TestResult> results;
    for (const Step& step : steps_to_test(law, spacing)) {
        auto name = fmt::format("{} to {}", to_text(step.from), to_text(step.to));
        results.push_back(frequency(std::move(name), counts.of(step.from, step.to),
                                    counts.from(step.from), step.probability, alpha));
    }
    return results;
}

std::vector<TestResult> test_losses_in_states(const LossLaw& law, std::span<const LossState> states,
                                              std::span<const std::uint8_t> lost, double alpha)
{
    base::ensure(states.size() == lost.size());
    // Any spacing will do: what is lost in a state does not depend on the steps.
    const auto steps = two_state_steps(law, base::Duration{1});
    if (!steps) return {};
    std::array<std::uint64_t, 2> seen{};
    std::array<std::uint64_t, 2> gone{};
    for (std::size_t i = 0; i < states.size(); ++i) {
        const std::size_t state = states[i] == LossState::bad ? 1 : 0;
        ++seen[state];
        gone[state] += lost[i];
    }
    return {frequency("lost while good", gone[0], seen[0], steps->loss_good, alpha),
            frequency("lost while bad", gone[1], seen[1], steps->loss_bad, alpha)};
}

} // namespace hapnet::emulator
