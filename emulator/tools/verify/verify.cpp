// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/verify/verify.hpp"

#include "emulator/core/pipeline.hpp"
#include "emulator/tools/verify/delays.hpp"
#include "emulator/tools/verify/exact.hpp"
#include "emulator/tools/verify/losses.hpp"
#include "emulator/tools/verify/properties.hpp"
#include "emulator/tools/verify/regimes.hpp"

#include <algorithm>
#include <iterator>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator::tools {

namespace {

using Results = std::vector<TestResult>;

bool is_in_time(const Variation& variation)
{
    return variation.correlation_time > base::Duration{0} ||
           std::holds_alternative<TraceLaw>(variation.law);
}

bool is_in_time(const Conditions& conditions)
{
    for (std::size_t i = 0; i < conditions.regimes.all.size(); ++i) {
        if (is_in_time(in_regime(conditions, i))) return true;
    }
    return is_in_time(conditions.delay) || is_in_time(conditions.jitter) ||
           std::any_of(conditions.loss.begin(), conditions.loss.end(),
                       [](const LossLaw& law) { return is_in_time(law); });
}

/// Tests that the seed gives these fates, in their regimes.
TestResult verify_seed(const Claim& claim, Direction direction, std::span<const Fate> fates)
{
    const auto& conditions = direction == Direction::up ? claim.path.up : claim.path.down;
    if (!claim.seed) return unable("seed", "the seed of the run is not known");
    if (is_in_time(conditions) || conditions.mtu.bytes_max > 0) {
        return unable("seed", "the fates depend on when datagrams came or on their lengths");
    }
    Pipeline pipeline{conditions, *claim.seed, direction, claim.name};
    std::vector<Fate> expected;
    expected.reserve(fates.size());
    for (std::uint64_t number = 0; number < fates.size(); ++number) {
        const std::uint8_t regime = fates[number].regime;
        const Fate drawn = regime == 0 ? pipeline.on_packet({.number = number})
                                       : pipeline.on_packet({.number = number}, regime - 1U);
        const bool arrived_too_soon = fates[number].drop == DropCause::no_destination;
        expected.push_back(arrived_too_soon ? without_destination(drawn) : drawn);
    }
    auto result = test_equal(expected, fates);
    result.name = "seed";
    return result;
}

/// Returns the memory of a direction's losses; nullopt when they are not drawn one by one.
std::optional<double> memory_of(const std::vector<LossLaw>& laws,
                                std::optional<base::Duration> spacing)
{
    if (laws.empty()) return std::nullopt;
    double most = 0.0;
    for (const LossLaw& law : laws) {
        const auto memory = theory_of(law, {spacing.value_or(base::Duration{1}), 1}).memory;
        if (!memory || (is_in_time(law) && !spacing)) return std::nullopt;
        most = std::max(most, *memory);
    }
    return most;
}

Results verify_between(const Claim& claim, std::span<const Fate> up, std::span<const Fate> down)
{
    if (!claim.path.up.regimes.empty() || !claim.path.down.regimes.empty()) {
        return {unable("directions", "with regimes, losses are not drawn one by one")};
    }
    const auto memory_up = memory_of(claim.path.up.loss, claim.spacing);
    const auto memory_down = memory_of(claim.path.down.loss, claim.spacing);
    if (!memory_up || !memory_down) {
        return {unable("directions", "the losses of one of them are not drawn one by one")};
    }
    PairTally tally;
    for (std::size_t i = 0; i < std::min(up.size(), down.size()); ++i) {
        tally.add(up[i].is_lost(), down[i].is_lost());
    }
    return {test_unrelated(tally, *memory_up * *memory_down, claim.alpha)};
}

bool any_failed(const Results& results)
{
    return std::any_of(results.begin(), results.end(),
                       [](const TestResult& result) { return result.outcome == Outcome::failed; });
}

void append_lines(std::string& text, std::string_view part, const Results& results)
{
    for (const TestResult& result : results) {
        const bool is_unable = result.outcome == Outcome::unable;
        const auto p = result.p_value ? fmt::format("p = {:.3g}", *result.p_value)
                       : is_unable    ? ""
                                      : "exact";
        text += fmt::format("{:<8} {:<38} {:<11} {:<14} {}\n", part, result.name,
                            is_unable ? "cannot tell" : base::name_of(result.outcome), p,
                            result.sentence);
    }
}

} // namespace

bool Verification::failed() const
{
    return any_failed(up) || any_failed(down) || any_failed(between);
}

Verification verify(const Claim& claim, std::span<const Fate> up, std::span<const Fate> down)
{
    return {verify_direction(claim, Direction::up, up),
            verify_direction(claim, Direction::down, down), verify_between(claim, up, down)};
}

std::vector<TestResult> verify_direction(const Claim& claim, Direction direction,
                                         std::span<const Fate> fates)
{
    if (fates.empty()) return {unable("fates", "no datagram passed in this direction")};
    const auto& conditions = direction == Direction::up ? claim.path.up : claim.path.down;
    const Regimes& regimes = conditions.regimes;
    const bool are_foreign = std::ranges::any_of(
        fates, [&](const Fate& fate) { return fate.regime > regimes.all.size(); });
    if (are_foreign) return {unable("regimes", "the fates have regimes, and the profile has none")};
    Results results{verify_seed(claim, direction, fates)};
    if (!regimes.empty()) {
        auto within = verify_regimes(conditions, fates, claim.spacing, claim.alpha);
        results.insert(results.end(), within.begin(), within.end());
        return results;
    }
    for (auto& part : {verify_losses(conditions.loss, loss_record(fates, conditions.loss.size()),
                                     claim.spacing, claim.alpha),
                       verify_delays(conditions, fates, claim.spacing, claim.alpha)}) {
        results.insert(results.end(), part.begin(), part.end());
    }
    return results;
}

std::string to_text(const Verification& verification)
{
    std::string text;
    append_lines(text, "up", verification.up);
    append_lines(text, "down", verification.down);
    append_lines(text, "between", verification.between);
    text += verification.failed() ? "verdict  failed: the run did not do what it was asked to\n"
                                  : "verdict  passed\n";
    return text;
}

} // namespace hapnet::emulator::tools
