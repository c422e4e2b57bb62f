// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/verify/properties.hpp"

#include "emulator/tools/verify/exact.hpp"
#include "emulator/tools/verify/losses.hpp"
#include "emulator/tools/verify/states.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator::tools {

namespace {

using Results = std::vector<TestResult>;

void append(Results& results, Results more)
{
    results.insert(results.end(), std::make_move_iterator(more.begin()),
                   std::make_move_iterator(more.end()));
}

LossTally tally_of(std::span<const std::uint8_t> lost, std::size_t stride = 1)
{
    LossTally tally{stride};
    for (const auto one : lost) tally.add(one != 0);
    return tally;
}

/// Returns the stride at which the lengths of runs are independent.
std::size_t stride_of(const RunLengths& runs)
{
    constexpr double forgotten = 1e-3;
    if (runs.memory < forgotten) return 1;
    return 1 + static_cast<std::size_t>(std::ceil(std::log(forgotten) / std::log(runs.memory)));
}

/// Runs the test of each property.
struct Tester {
    std::span<const std::uint8_t> lost;
    std::span<const LossState> states;
    double alpha = 0.0;

    Results operator()(const IndependentLosses& losses) const
    {
        const auto tally = tally_of(lost);
        return {test_count(tally, losses.share, alpha), test_independence(tally, alpha),
                test_number_of_runs(tally, alpha)};
    }
    Results operator()(const LongRunShare& share) const
    {
        return {test_share(tally_of(lost), share.theory, alpha)};
    }
    Results operator()(const RunLengths& runs) const
    {
        return {test_run_lengths(tally_of(lost, stride_of(runs)), runs, alpha)};
    }
    Results operator()(const ExactBlocks& blocks) const
    {
        return {test_blocks(lost, blocks), test_places(lost, blocks, alpha)};
    }
    Results operator()(const RecurringBursts& bursts) const { return {test_bursts(lost, bursts)}; }
    Results operator()(const SameLosses& same) const { return {test_same_losses(same.lost, lost)}; }
    Results operator()(const LossesInState& losses) const
    {
        return {test_losses_in_state(losses, states, lost, alpha)};
    }
    Results operator()(const StateStep& step) const { return {test_step(step, states, alpha)}; }
    Results operator()(const Untestable& untestable) const
    {
        return {unable("losses", std::string{untestable.reason})};
    }
};

/// Tests the share of losses of several laws together.
Results verify_together(const std::vector<LossLaw>& laws, std::span<const std::uint8_t> lost,
                        std::optional<base::Duration> spacing, double alpha)
{
    if (!spacing && std::any_of(laws.begin(), laws.end(), is_in_time)) {
        return {unable("losses", "one of the laws is in time, and the spacing of the datagrams "
                                 "is not known")};
    }
    double passes = 1.0;
    LossTheory all{.variance_inflation = 1.0};
    for (const LossLaw& law : laws) {
        const auto one = theory_of(law, {spacing.value_or(base::Duration{1}), lost.size()});
        passes *= 1.0 - one.share;
        // Losses by any of several independent laws do not vary more than those of the law that
        // varies most.
        all.variance_inflation = std::max(all.variance_inflation, one.variance_inflation);
    }
    all.share = 1.0 - passes;
    return {test_share(tally_of(lost), all, alpha)};
}

} // namespace

LossRecord loss_record(std::span<const Fate> fates, std::size_t laws)
{
    LossRecord record{.lost = {}, .states = std::vector<std::vector<LossState>>(laws)};
    record.lost.reserve(fates.size());
    for (const Fate& fate : fates) {
        record.lost.push_back(fate.is_lost() ? 1 : 0);
        if (fate.drop == DropCause::mtu) record.is_hidden = true;
        for (std::size_t i = 0; i < laws; ++i) record.states[i].push_back(fate.states[i]);
    }
    return record;
}

std::vector<TestResult> verify_properties(const std::vector<LossProperty>& properties,
                                          std::span<const std::uint8_t> lost,
                                          std::span<const LossState> states, double alpha)
{
    Results results;
    for (const LossProperty& property : properties) {
        append(results, std::visit(Tester{lost, states, alpha}, property));
    }
    return results;
}

std::vector<TestResult> verify_losses(const std::vector<LossLaw>& laws, const LossRecord& record,
                                      std::optional<base::Duration> spacing, double alpha)
{
    Results results;
    const bool is_alone = laws.size() == 1 && !record.is_hidden;
    if (record.is_hidden) {
        results.push_back(unable("losses", "datagrams above the MTU were dropped before the laws "
                                           "of loss could take them"));
    } else if (laws.empty()) {
        const auto lost = std::count(record.lost.begin(), record.lost.end(), std::uint8_t{1});
        results.push_back(
            exactly("losses", lost == 0, fmt::format("no law of loss, {} were lost", lost)));
    } else if (!is_alone) {
        append(results, verify_together(laws, record.lost, spacing, alpha));
    }
    for (std::size_t i = 0; i < laws.size(); ++i) {
        auto properties = properties_of(laws[i], {record.lost.size(), spacing});
        if (!is_alone) {
            std::erase_if(properties, [](const LossProperty& property) {
                return !std::holds_alternative<StateStep>(property);
            });
        }
        append(results, verify_properties(properties, record.lost, record.states[i], alpha));
    }
    return results;
}

} // namespace hapnet::emulator::tools
