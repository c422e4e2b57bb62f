// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/conditions.hpp"

#include "proto/base/text.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
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

bool Regimes::empty() const { return all.empty(); }

bool operator==(const Regimes& a, const Regimes& b)
{
    return a.are_together == b.are_together && a.all == b.all;
}

namespace {

base::Result<void> validate_weights(const Regime& regime, const std::vector<Regime>& all)
{
    double sum = 0.0;
    for (const auto& [name, weight] : regime.to) {
        if (name == regime.name) {
            return base::fail(fmt::format("regime '{}' cannot follow itself: a longer stay says "
                                          "that",
                                          name));
        }
        if (std::ranges::find(all, name, &Regime::name) == all.end()) {
            return base::fail(fmt::format("to of regime '{}' names '{}', which is no regime here",
                                          regime.name, name));
        }
        if (!std::isfinite(weight) || weight < 0.0 || weight > 1e9) {
            return base::fail(
                fmt::format("to of regime '{}': a weight is a number from 0 to 1e9", regime.name));
        }
        sum += weight;
    }
    if (regime.to.empty() || sum > 0.0) return {};
    return base::fail(
        fmt::format("nothing follows regime '{}': give to a weight above 0", regime.name));
}

/// Returns the number of regimes that can follow the one at `from` sooner or later, itself
/// included. With `backwards` it is the number of those that can come before it.
std::size_t reached(const std::vector<Regime>& all, std::size_t from, bool backwards)
{
    const auto follows = [&](std::size_t a, std::size_t b) {
        const Weights& to = all[a].to;
        const auto own = std::ranges::find(to, all[b].name, &Weights::value_type::first);
        return to.empty() || (own != to.end() && own->second > 0.0);
    };
    std::vector<std::size_t> found{from};
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (std::size_t next = 0; next < all.size(); ++next) {
            const bool is_new = std::ranges::find(found, next) == found.end();
            const bool is_linked = backwards ? follows(next, found[i]) : follows(found[i], next);
            if (is_new && is_linked) found.push_back(next);
        }
    }
    return found.size();
}

} // namespace

base::Result<void> validate(const Regimes& regimes)
{
    constexpr base::Duration shortest = std::chrono::milliseconds{1};
    constexpr base::Duration longest = std::chrono::hours{720};
    const auto& all = regimes.all.get();
    if (all.empty()) return {};
    if (all.size() < 2 || all.size() > regimes_max) {
        return base::fail(fmt::format("a direction has 2 to {} regimes, or none: there {} {}",
                                      regimes_max, all.size() == 1 ? "is" : "are", all.size()));
    }
    for (const Regime& regime : all) {
        if (std::ranges::count(all, regime.name, &Regime::name) > 1) {
            return base::fail(
                fmt::format("there are two regimes '{}': give each its own name", regime.name));
        }
        if (regime.stay < shortest || regime.stay > longest) {
            return base::fail(fmt::format("stay of regime '{}' must be from 1ms to 720h, not {}",
                                          regime.name, base::to_text(regime.stay)));
        }
        if (auto valid = validate_weights(regime, all); !valid) return valid;
    }
    for (const bool backwards : {false, true}) {
        if (reached(all, 0, backwards) == all.size()) continue;
        return base::fail("the regimes fall apart: let each of them follow sooner or later, by "
                          "the weights of to");
    }
    return {};
}

bool have_same_course(const Regimes& a, const Regimes& b)
{
    return a.are_together == b.are_together &&
           std::ranges::equal(a.all, b.all, [](const Regime& one, const Regime& other) {
               return one.name == other.name && one.stay == other.stay && one.to == other.to;
           });
}

std::vector<std::string> regime_names(const Regimes& regimes)
{
    std::vector<std::string> names;
    for (const Regime& regime : regimes.all) names.push_back(regime.name);
    return names;
}

Conditions in_regime(const Conditions& conditions, std::size_t index)
{
    Conditions own = patched(conditions, conditions.regimes.all[index].own);
    own.regimes = {};
    return own;
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
