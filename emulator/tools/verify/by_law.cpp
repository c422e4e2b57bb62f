// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/verify/by_law.hpp"

#include "emulator/core/loss/process.hpp"
#include "emulator/core/loss/theory.hpp"
#include "emulator/tools/verify/chains.hpp"
#include "emulator/tools/verify/exact.hpp"
#include "emulator/tools/verify/losses.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

using Results = std::vector<TestResult>;

constexpr std::size_t run_length_max = 10'000; // what is longer falls into the last bin

struct Evidence {
    const LossRecord& record;
    std::optional<base::Duration> spacing;
    double alpha = 0.0;
};

LossTally tally_of(const Evidence& evidence, std::size_t stride = 1)
{
    LossTally tally{stride};
    for (const auto lost : evidence.record.lost) tally.add(lost != 0);
    return tally;
}

Arrivals arrivals_of(const Evidence& evidence)
{
    // The spacing is asked for by laws in time alone, and those are not tested without it.
    return {evidence.spacing.value_or(base::Duration{1}), evidence.record.lost.size()};
}

void append(Results& results, Results more)
{
    results.insert(results.end(), std::make_move_iterator(more.begin()),
                   std::make_move_iterator(more.end()));
}

/// Of which runs the lengths have nothing to do with each other.
std::size_t stride_of(const RunLaw& law)
{
    constexpr double forgotten = 1e-3;
    if (law.memory < forgotten) return 1;
    return 1 + static_cast<std::size_t>(std::ceil(std::log(forgotten) / std::log(law.memory)));
}

Results verify_runs(const LossLaw& law, const Evidence& evidence)
{
    const auto runs = run_law_of(law, arrivals_of(evidence).spacing, run_length_max);
    if (!runs) return {};
    return {test_run_lengths(tally_of(evidence, stride_of(*runs)), *runs, evidence.alpha)};
}

Results verify_independent(const RandomLoss& law, const Evidence& evidence)
{
    const auto tally = tally_of(evidence);
    Results results{test_count(tally, law.share.fraction(), evidence.alpha),
                    test_independence(tally, evidence.alpha),
                    test_number_of_runs(tally, evidence.alpha)};
    append(results, verify_runs(law, evidence));
    return results;
}

Results verify_chain(const LossLaw& law, const Evidence& evidence)
{
    Results results;
    if (is_in_time(law) && !evidence.spacing) {
        results.push_back(unable("losses", "a law in time, and the spacing of the datagrams is "
                                           "not known"));
    } else {
        results.push_back(
            test_share(tally_of(evidence), theory_of(law, arrivals_of(evidence)), evidence.alpha));
        append(results, verify_runs(law, evidence));
    }
    append(results, test_losses_in_states(law, evidence.record.states.front(), evidence.record.lost,
                                          evidence.alpha));
    return results;
}

/// Of a law that draws nothing, by judging the same numbers again.
Results verify_repeatable(const LossLaw& law, const Evidence& evidence)
{
    LossProcess process{law, base::Seed{}.stream("")};
    std::vector<std::uint8_t> expected;
    for (std::uint64_t number = 0; number < evidence.record.lost.size(); ++number) {
        expected.push_back(process.on_packet({.number = number}).cause ? 1 : 0);
    }
    return {test_same_losses(expected, evidence.record.lost)};
}

Results verify_one(const LossLaw& law, const Evidence& evidence)
{
    if (const auto* random = std::get_if<RandomLoss>(&law)) {
        return verify_independent(*random, evidence);
    }
    if (const auto* block = std::get_if<BlockLoss>(&law)) {
        return {test_blocks(evidence.record.lost, *block),
                test_places(evidence.record.lost, *block, evidence.alpha)};
    }
    if (const auto* burst = std::get_if<Burst>(&law)) {
        return {test_bursts(evidence.record.lost, *burst)};
    }
    if (std::holds_alternative<TimedBurst>(law) || std::holds_alternative<Outage>(law)) {
        return {unable("losses", "which datagrams are lost depends on when they came, and fates "
                                 "do not say that")};
    }
    if (memory_of(law, evidence.spacing) || is_in_time(law)) return verify_chain(law, evidence);
    return verify_repeatable(law, evidence);
}

Results verify_together(const std::vector<LossLaw>& laws, const Evidence& evidence)
{
    if (!evidence.spacing && std::any_of(laws.begin(), laws.end(), is_in_time)) {
        return {unable("losses", "one of the laws is in time, and the spacing of the datagrams "
                                 "is not known")};
    }
    double passes = 1.0;
    LossTheory all{.variance_inflation = 1.0};
    for (const LossLaw& law : laws) {
        const auto one = theory_of(law, arrivals_of(evidence));
        passes *= 1.0 - one.share;
        // That of losses by any of several independent laws is not above the largest.
        all.variance_inflation = std::max(all.variance_inflation, one.variance_inflation);
    }
    all.share = 1.0 - passes;
    return {test_share(tally_of(evidence), all, evidence.alpha)};
}

} // namespace

bool is_in_time(const LossLaw& law)
{
    return std::holds_alternative<TimedBurst>(law) || std::holds_alternative<Outage>(law) ||
           std::holds_alternative<TimedGilbertElliott>(law);
}

std::optional<double> memory_of(const LossLaw& law, std::optional<base::Duration> spacing)
{
    // Two sequences in blocks of n meet the variance of independent ones times 1 + 1 / (n - 1).
    if (const auto* block = std::get_if<BlockLoss>(&law)) return 1.0 / std::sqrt(block->of);
    const bool is_drawn =
        std::holds_alternative<RandomLoss>(law) || std::holds_alternative<Gilbert>(law) ||
        std::holds_alternative<GilbertElliott>(law) || std::holds_alternative<FourState>(law) ||
        (std::holds_alternative<TimedGilbertElliott>(law) && spacing);
    if (!is_drawn) return std::nullopt;
    const auto theory = theory_of(law, {spacing.value_or(base::Duration{1}), 1});
    const double inflation = std::max(theory.variance_inflation, 1.0);
    return (inflation - 1.0) / (inflation + 1.0);
}

LossRecord loss_record(std::span<const Fate> fates, std::size_t laws)
{
    LossRecord record{.lost = {}, .states = std::vector<std::vector<LossState>>(laws)};
    record.lost.reserve(fates.size());
    for (const Fate& fate : fates) {
        const auto* drop = std::get_if<Drop>(&fate.verdict);
        record.lost.push_back(drop != nullptr ? 1 : 0);
        if (drop != nullptr && drop->cause == DropCause::mtu) record.is_hidden = true;
        for (std::size_t i = 0; i < laws; ++i) record.states[i].push_back(fate.states[i]);
    }
    return record;
}

std::vector<TestResult> verify_losses(const std::vector<LossLaw>& laws, const LossRecord& record,
                                      std::optional<base::Duration> spacing, double alpha)
{
    const Evidence evidence{record, spacing, alpha};
    Results results;
    if (record.is_hidden) {
        results.push_back(unable("losses", "datagrams above the MTU hide what the laws of loss "
                                           "would have done with them"));
    } else if (laws.empty()) {
        const auto lost = std::count(record.lost.begin(), record.lost.end(), std::uint8_t{1});
        results.push_back(
            exactly("losses", lost == 0, fmt::format("no law of loss, {} were lost", lost)));
    } else if (laws.size() == 1) {
        append(results, verify_one(laws.front(), evidence));
    } else {
        append(results, verify_together(laws, evidence));
    }
    for (std::size_t i = 0; i < laws.size(); ++i) {
        append(results, test_steps(laws[i], record.states[i], spacing, alpha));
    }
    return results;
}

} // namespace hapnet::emulator
