// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/validated.hpp"

#include "emulator/core/loss/steps.hpp"
#include "emulator/core/loss/trace.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

using Complaint = std::optional<std::string>;

constexpr base::Duration zero{0};

/// Rounded up in the last of its decimals, so that writing it is enough.
std::string at_least(double value)
{
    constexpr double thousand = 1000.0;
    return fmt::format("{}", std::ceil(value * thousand) / thousand);
}

Complaint complaint(const RandomLoss&) { return {}; }

Complaint complaint(const BlockLoss& law)
{
    if (law.lost > 0 && law.lost <= law.of) return {};
    return fmt::format("loses {} of {}: at least 1 is lost, and at most all, as in 40/100",
                       law.lost, law.of);
}

Complaint complaint(const PeriodicLoss& law)
{
    if (law.every == 0) return "every 0th is lost: write 1 or more";
    if (law.phase < law.every) return {};
    return fmt::format("the phase {} is not within the period: write 0 to {}", law.phase,
                       law.every - 1);
}

Complaint complaint(const Burst& law)
{
    if (law.lost == 0 || law.lost > law.of) {
        return fmt::format("loses {} of {}: at least 1 is lost, and at most all, as in 40/100",
                           law.lost, law.of);
    }
    if (!law.phase || *law.phase < law.of) return {};
    return fmt::format("the phase {} is not within the period: write 0 to {}", *law.phase,
                       law.of - 1);
}

Complaint complaint(const TimedBurst& law)
{
    if (law.every <= zero) return "the period of the bursts is 0: write a time above 0";
    if (const auto* lost = std::get_if<base::Duration>(&law.lost)) {
        if (*lost <= zero || *lost > law.every) {
            return fmt::format("a burst lasts longer than 0 and at most its period of {}",
                               base::to_text(law.every));
        }
    } else if (std::get<std::uint32_t>(law.lost) == 0) {
        return "a burst of no datagram: at least 1 is lost";
    }
    if (!law.phase || (*law.phase >= zero && *law.phase < law.every)) return {};
    return fmt::format("the phase is not within the period: write less than {}",
                       base::to_text(law.every));
}

Complaint complaint(const Gilbert& law)
{
    const double share = law.share.fraction();
    if (share >= 1.0) {
        return "a share of 100% has no end of a burst: write less, or loss by the law random";
    }
    const double least = share / (1.0 - share);
    if (std::isfinite(law.mean_burst) && law.mean_burst >= 1.0 && law.mean_burst > least) return {};
    if (least < 1.0) return "the mean burst is at least 1 datagram";
    return fmt::format("at a share of {} the mean burst is more than share / (1 - share) = {:.4g} "
                       "datagrams, or the good runs between bursts would be shorter than one",
                       base::to_text(law.share), least);
}

Complaint complaint(const GilbertElliott& law)
{
    if (law.good_to_bad.fraction() > 0.0 || law.bad_to_good.fraction() > 0.0) return {};
    return "good_to_bad and bad_to_good are both 0%: the state would never change; write at least "
           "one of them";
}

Complaint complaint(const TimedGilbertElliott& law)
{
    if (law.mean_good > zero && law.mean_bad > zero) return {};
    return "the mean times in the good and in the bad state are both longer than 0";
}

/// What the shares and lengths have to be, each by itself or to each other.
Complaint four_state_ranges(const FourState& law)
{
    if (!(law.isolated < law.share && law.share < law.density)) {
        return fmt::format("isolated ({}) < share ({}) < density ({}) does not hold: bursts lose "
                           "more than the whole does, and the gaps between them less",
                           base::to_text(law.isolated), base::to_text(law.share),
                           base::to_text(law.density));
    }
    if (!(std::isfinite(law.burst) && law.burst >= 1.0)) return "a burst is at least 1 long";
    if (!(std::isfinite(law.good_run) && law.good_run >= 1.0)) {
        return "a good run within a burst is at least 1 long";
    }
    if (law.isolated.fraction() >= 0.5) {
        return "isolated losses are each followed by a datagram that passes: write less than 50%";
    }
    return {};
}

Complaint complaint(const FourState& law)
{
    if (auto wrong = four_state_ranges(law)) return wrong;
    const auto steps = steps_of(law);
    const double density = law.density.fraction();
    constexpr double rounding = 1e-12;
    if (steps.burst_to_gap + steps.burst_to_good_run > 1.0 + rounding) {
        const double thinnest = (1.0 - density) / law.good_run;
        if (thinnest >= density) {
            return fmt::format("good runs of mean length {} do not leave a burst a density of {}: "
                               "write more than {} for good_run",
                               law.good_run, base::to_text(law.density),
                               at_least((1.0 - density) / density));
        }
        return fmt::format("bursts of density {} with good runs of {} are at least {} long",
                           base::to_text(law.density), law.good_run,
                           at_least(1.0 / (density - thinnest)));
    }
    if (steps.gap_to_burst + steps.gap_to_isolated > 1.0 + rounding) {
        const double share = law.share.fraction();
        const double isolated = law.isolated.fraction();
        return fmt::format(
            "bursts of {} are too short for a share of {}, as each is followed by a gap: write at "
            "least {}, or a higher density",
            law.burst, base::to_text(law.share),
            at_least((share - isolated) / ((density - share) * (1.0 - 2.0 * isolated))));
    }
    return {};
}

Complaint complaint(const ListedLoss& law)
{
    const auto wrong =
        std::adjacent_find(law.numbers.begin(), law.numbers.end(), std::greater_equal<>{});
    if (wrong == law.numbers.end()) return {};
    return fmt::format("the numbers ascend, but {} comes before {}", *wrong, *(wrong + 1));
}

Complaint complaint(const PatternLoss& law)
{
    if (!law.pattern.empty()) return {};
    return "an empty pattern: write 0 (passes) and 1 (lost), such as \"0010\"";
}

Complaint complaint(const TraceLoss& law)
{
    if (law.trace) return {};
    return "a trace of losses without its datagrams";
}

Complaint complaint(const Outage& law)
{
    base::Duration last{0};
    for (const Window& window : law.windows) {
        const auto text = fmt::format("the outage from {} to {}", base::to_text(window.from),
                                      base::to_text(window.to));
        if (window.from >= window.to) return text + " ends before it begins";
        if (window.from < last) {
            return fmt::format("{} begins before {}: outages ascend and do not overlap", text,
                               base::to_text(last));
        }
        last = window.to;
    }
    return {};
}

} // namespace

base::Result<LossLaw> validated(LossLaw law)
{
    if (auto wrong = std::visit([](const auto& one) { return complaint(one); }, law)) {
        return base::fail(std::move(*wrong));
    }
    return law;
}

} // namespace hapnet::emulator
