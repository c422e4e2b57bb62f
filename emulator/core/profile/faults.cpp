// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/faults.hpp"

#include "proto/base/text.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

using Fault = std::optional<std::string>;

constexpr base::Duration zero{0};

Fault unless(bool is_possible, std::string_view what)
{
    return is_possible ? Fault{} : Fault{what};
}

Fault first_of(Fault a, Fault b) { return a ? std::move(a) : std::move(b); }

constexpr std::string_view negative_width = "a width or deviation is not negative";
constexpr std::string_view mean_not_positive = "mean has to be more than 0";

Fault fault(const ConstantLaw& law)
{
    return unless(law.value >= zero, "a delay is not negative: nothing leaves before it came");
}
Fault fault(const UniformLaw& law) { return unless(law.half_width >= zero, negative_width); }
Fault fault(const NormalLaw& law) { return unless(law.sd >= zero, negative_width); }
Fault fault(const LogNormalLaw& law)
{
    return first_of(unless(law.mean > zero, mean_not_positive),
                    unless(law.sd >= zero, negative_width));
}
Fault fault(const ExponentialLaw& law) { return unless(law.mean > zero, mean_not_positive); }
Fault fault(const ParetoLaw& law)
{
    return first_of(unless(law.mean > zero, mean_not_positive),
                    unless(law.shape > 1.0, "shape has to be more than 1, or there is no mean"));
}
Fault fault(const GammaLaw& law)
{
    return first_of(unless(law.mean > zero, mean_not_positive),
                    unless(law.sd > zero, "sd has to be more than 0"));
}
Fault fault(const TableLaw& law) { return unless(law.sd >= zero, negative_width); }
Fault fault(const TraceLaw&) { return {}; }

Fault fault(const RandomLoss&) { return {}; }
Fault lost_of(std::uint32_t lost, std::uint32_t of)
{
    return unless(lost > 0 && lost <= of,
                  fmt::format("{} of {} cannot be lost: write 0 < lost <= of", lost, of));
}
Fault fault(const BlockLoss& law) { return lost_of(law.lost, law.of); }
Fault fault(const PeriodicLoss& law)
{
    return first_of(unless(law.every > 0, "every has to be more than 0"),
                    unless(law.phase < law.every, "phase has to be less than every"));
}
Fault fault(const Burst& law)
{
    return first_of(lost_of(law.lost, law.of), unless(law.phase.value_or(0) < std::max(law.of, 1U),
                                                      "phase has to be less than of"));
}
Fault fault(const TimedBurst& law)
{
    const auto phase = law.phase.value_or(zero);
    const auto* time = std::get_if<base::Duration>(&law.lost);
    const auto* count = std::get_if<std::uint32_t>(&law.lost);
    return first_of(first_of(unless(law.every > zero, "every has to be more than 0"),
                             unless(phase >= zero && phase < std::max(law.every, base::Duration{1}),
                                    "phase has to be from 0 to less than every")),
                    first_of(unless(time == nullptr || (*time > zero && *time <= law.every),
                                    "lost has to be more than 0 and at most every"),
                             unless(count == nullptr || *count > 0, "lost has to be more than 0")));
}
Fault fault(const Gilbert& law)
{
    const double share = law.share.fraction();
    return first_of(
        unless(law.mean_burst >= 1.0, "mean_burst is counted in datagrams: it is at least 1"),
        unless(share < 1.0 && law.mean_burst > share / (1.0 - share),
               fmt::format("so high a share needs longer bursts: mean_burst has to be more than "
                           "share / (1 - share) = {:.4g}",
                           share / (1.0 - share))));
}
Fault fault(const GilbertElliott&) { return {}; }
Fault fault(const TimedGilbertElliott& law)
{
    return unless(law.mean_good > zero && law.mean_bad > zero,
                  "mean_good and mean_bad have to be more than 0");
}
Fault fault(const FourState& law)
{
    const double share = law.share.fraction();
    const double density = law.density.fraction();
    const double isolated = law.isolated.fraction();
    if (!(law.good_run >= 1.0)) return "good_run is counted in datagrams: it is at least 1";
    if (!(isolated < share && share < density)) {
        return "what is possible is isolated < share < density";
    }
    if (!(law.burst > 0.0)) return "burst has to be more than 0";
    // Salsano et al. 2012: the transitions that these five numbers stand for.
    const double p14 = isolated / (1.0 - isolated);
    const double p23 = 1.0 / law.good_run;
    const double p32 = p23 * (1.0 - density) / density;
    const double p31 = 1.0 / (density * law.burst);
    const double p13 = (share - isolated) / (law.burst * (1.0 - isolated) * (density - share));
    if (p31 + p32 > 1.0) {
        return fmt::format("such a burst is too short for its density: p31 + p32 = {:.3g} is more "
                           "than 1",
                           p31 + p32);
    }
    return unless(p13 + p14 <= 1.0,
                  fmt::format("so much loss needs longer bursts: p13 + p14 = {:.3g} is more than 1",
                              p13 + p14));
}
Fault fault(const ListedLoss& law)
{
    const bool ascends = std::adjacent_find(law.numbers.begin(), law.numbers.end(),
                                            std::greater_equal<>{}) == law.numbers.end();
    return unless(ascends, "the numbers have to ascend");
}
Fault fault(const PatternLoss& law)
{
    return unless(!law.pattern.empty(), "a pattern needs at least one 0 or 1");
}
Fault fault(const TraceLoss&) { return {}; }
Fault fault(const Outage& law)
{
    base::Duration last{-1};
    for (const Window& window : law.windows) {
        if (window.from >= window.to) return "a window has to end after it begins";
        if (window.from <= last) return "windows have to ascend and to be apart from each other";
        last = window.to;
    }
    return {};
}

} // namespace

std::optional<std::string> fault_of(const Variation& variation)
{
    const bool is_trace = std::holds_alternative<TraceLaw>(variation.law);
    const auto time = variation.correlation_time;
    return first_of(std::visit([](const auto& law) { return fault(law); }, variation.law),
                    first_of(unless(time >= zero, "correlation_time is not negative"),
                             unless(!is_trace || time == zero,
                                    "a trace has no correlation_time: it is as it was measured")));
}

std::optional<std::string> fault_of(const LossLaw& law)
{
    return std::visit([](const auto& one) { return fault(one); }, law);
}

std::optional<std::string> fault_of(const Corruption& corruption)
{
    return unless(corruption.bits >= 1 && corruption.bits <= Flips::most,
                  fmt::format("bits has to be from 1 to {}", Flips::most));
}

std::optional<std::string> fault_of(const Duplication& duplication)
{
    return unless(duplication.spread >= zero, "spread is not negative");
}

std::optional<std::string> fault_of(const Reordering& reordering)
{
    const Displacement& displacement = reordering.displacement;
    return first_of(unless(displacement.time >= zero, "displacement is not negative"),
                    unless(reordering.share == base::Probability{} || displacement.places > 0 ||
                               displacement.time > zero,
                           "displacement has to be more than 0"));
}

std::optional<std::string> fault_of(const Mtu& mtu)
{
    return unless(
        mtu.bytes_max == 0 || mtu.bytes_max >= Mtu::header_bytes,
        fmt::format("the headers alone have {} B: nothing would pass", Mtu::header_bytes));
}

std::optional<std::string> fault_of(const Rate& rate)
{
    constexpr std::size_t overhead_max = 1000;
    return unless(rate.overhead_bytes <= overhead_max, "overhead is at most 1000B");
}

} // namespace hapnet::emulator
