// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/faults.hpp"

#include "emulator/core/loss/validated.hpp"

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
    const auto checked = validated(law);
    return checked ? Fault{} : Fault{checked.error().message};
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
