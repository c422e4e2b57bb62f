// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/conditions.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

base::Result<void> validate(const Mtu& mtu)
{
    if (mtu.bytes_max == 0 || mtu.bytes_max >= Mtu::header_bytes) return {};
    return base::fail(fmt::format("nothing would pass: the IP and UDP headers alone have {} B",
                                  Mtu::header_bytes));
}

base::Result<void> validate(const Rate& rate)
{
    constexpr std::size_t overhead_max = 1000;
    return all({require(rate.overhead_bytes <= overhead_max, "overhead must be at most 1000B"),
                require(rate.burst_bytes <= Rate::burst_bytes_most, "burst must be at most 1GiB"),
                require(rate.burst_bytes == 0 || !rate.trace,
                        "burst goes with a limit: a trace says itself what may leave at once"),
                rate.trace ? rate.trace->validate() : base::Result<void>{}});
}

base::Result<void> validate(const Corruption& corruption)
{
    if (corruption.bits >= 1 && corruption.bits <= Flips::most) return {};
    return base::fail(fmt::format("bits must be from 1 to {}", Flips::most));
}

base::Result<void> validate(const Duplication& duplication)
{
    return require(duplication.spread >= base::Duration{0}, "spread must not be negative");
}

base::Result<void> validate(const Reordering& reordering)
{
    const Displacement& displacement = reordering.displacement;
    if (displacement.time < base::Duration{0}) {
        return base::fail("displacement must not be negative");
    }
    return require(
        reordering.share == base::Probability{} || displacement != Displacement{},
        "displacement must be more than 0: write '{ share = \"5%\", displacement = 3 }'");
}

Patch merged(Patch a, const Patch& b)
{
    for_each_setting([&](const auto& slot) {
        if (b.*slot.patch) a.*slot.patch = b.*slot.patch;
    });
    return a;
}

Patch to_patch(const Conditions& conditions)
{
    const Conditions defaults;
    Patch patch;
    for_each_setting([&](const auto& slot) {
        const auto& value = conditions.*slot.value;
        if (value != defaults.*slot.value) patch.*slot.patch = value;
    });
    return patch;
}

Conditions patched(Conditions conditions, const Patch& patch)
{
    for_each_setting([&](const auto& slot) {
        if (patch.*slot.patch) conditions.*slot.value = *(patch.*slot.patch);
    });
    return conditions;
}

} // namespace hapnet::emulator
