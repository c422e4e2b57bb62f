// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/faults.hpp"

#include "emulator/core/loss/validated.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

using Fault = std::optional<std::string>;

constexpr base::Duration no_time{0};

Fault fault_unless(bool is_possible, std::string_view what)
{
    return is_possible ? Fault{} : Fault{what};
}

} // namespace

std::optional<std::string> fault_of(const Variation& variation)
{
    const auto* constant = std::get_if<ConstantLaw>(&variation.law);
    if (constant != nullptr && constant->value < no_time) {
        return "a delay is not negative: nothing leaves before it came";
    }
    return objection(variation);
}

std::optional<std::string> fault_of(const LossLaw& law)
{
    const auto checked = validated(law);
    return checked ? Fault{} : Fault{checked.error().message};
}

std::optional<std::string> fault_of(const Corruption& corruption)
{
    return fault_unless(corruption.bits >= 1 && corruption.bits <= Flips::most,
                        fmt::format("bits has to be from 1 to {}", Flips::most));
}

std::optional<std::string> fault_of(const Duplication& duplication)
{
    return fault_unless(duplication.spread >= no_time, "spread is not negative");
}

std::optional<std::string> fault_of(const Reordering& reordering)
{
    const Displacement& displacement = reordering.displacement;
    if (displacement.time < no_time) return "displacement is not negative";
    return fault_unless(reordering.share == base::Probability{} || displacement != Displacement{},
                        "displacement has to be more than 0");
}

std::optional<std::string> fault_of(const Mtu& mtu)
{
    return fault_unless(
        mtu.bytes_max == 0 || mtu.bytes_max >= Mtu::header_bytes,
        fmt::format("the headers alone have {} B: nothing would pass", Mtu::header_bytes));
}

std::optional<std::string> fault_of(const Rate& rate)
{
    constexpr std::size_t overhead_max = 1000;
    return fault_unless(rate.overhead_bytes <= overhead_max, "overhead is at most 1000B");
}

} // namespace hapnet::emulator
