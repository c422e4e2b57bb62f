// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/ramp.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/ramp.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <type_traits>

namespace hapnet::emulator {

namespace {

// between(a, b, progress) returns the point between two values, or nullopt when there is none. base
// defines it for numbers and, field by field, for structs; the exceptions are here. Where the
// parameters of a law limit each other, the limits are convex: all laws between two valid laws are
// valid.

template <typename T>
std::optional<T> only_equal(const T& a, const T& b)
{
    return a == b ? std::optional{b} : std::nullopt;
}

/// Interpolates between two laws of one kind. The limits of FourState are not convex, and measured
/// delays that are used unchanged have no mean and sd to interpolate.
template <typename Laws>
std::optional<Laws> between_laws(const Laws& a, const Laws& b, double progress)
{
    if constexpr (std::is_same_v<Laws, LossLaw>) {
        if (std::holds_alternative<FourState>(b)) return only_equal(a, b);
    } else {
        constexpr base::Duration as_measured{0};
        const auto* from = std::get_if<TableLaw>(&a);
        const auto* to = std::get_if<TableLaw>(&b);
        const bool are_tables = from != nullptr && to != nullptr;
        if (are_tables && (from->sd == as_measured) != (to->sd == as_measured)) return std::nullopt;
    }
    return base::between(a, b, progress);
}

/// Returns a law of the kind of `other` that has no effect, if that kind can have none.
DelayLaw nothing_like(const DelayLaw& other)
{
    if (std::holds_alternative<UniformLaw>(other)) return UniformLaw{};
    if (std::holds_alternative<NormalLaw>(other)) return NormalLaw{};
    return ConstantLaw{};
}

std::optional<Variation> between(const Variation& a, const Variation& b, double progress)
{
    const auto from = is_nothing(a) ? nothing_like(b.law) : a.law;
    const auto to = is_nothing(b) ? nothing_like(a.law) : b.law;
    const auto law = between_laws(from, to, progress);
    if (!law) return std::nullopt;
    const auto time =
        base::between(is_nothing(a) ? b.correlation_time : a.correlation_time,
                      is_nothing(b) ? a.correlation_time : b.correlation_time, progress);
    return Variation{*law, *time};
}

std::optional<std::vector<LossLaw>> between(std::vector<LossLaw> a, std::vector<LossLaw> b,
                                            double progress)
{
    if (a.empty() && b.size() == 1) a = {RandomLoss{}};
    if (b.empty() && a.size() == 1) b = {RandomLoss{}};
    if (a.size() != b.size()) return std::nullopt;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const auto law = between_laws(a[i], b[i], progress);
        if (!law) return std::nullopt;
        b[i] = *law;
    }
    return b;
}

/// Interpolates. A value with a share of zero adopts the other parameters of the other value.
template <typename Stage>
std::optional<Stage> between_shares(Stage a, Stage b, double progress)
{
    const auto take = [](Stage& target, const Stage& other) {
        const Stage nothing{};
        if (target.share != nothing.share) return;
        target = other;
        target.share = nothing.share;
    };
    take(a, b);
    take(b, a);
    return base::between(a, b, progress);
}

std::optional<Corruption> between(const Corruption& a, const Corruption& b, double progress)
{
    return between_shares(a, b, progress);
}

std::optional<Duplication> between(const Duplication& a, const Duplication& b, double progress)
{
    return between_shares(a, b, progress);
}

std::optional<Reordering> between(const Reordering& a, const Reordering& b, double progress)
{
    return between_shares(a, b, progress);
}

std::optional<Mtu> between(const Mtu& a, const Mtu& b, double) { return only_equal(a, b); }

std::optional<QueueControl> between(const QueueControl& a, const QueueControl& b, double)
{
    return only_equal(a, b);
}

std::optional<Regimes> between(const Regimes& a, const Regimes& b, double)
{
    return only_equal(a, b);
}

std::optional<Order> between(Order a, Order b, double) { return only_equal(a, b); }

std::optional<Rate> between(const Rate& a, const Rate& b, double progress)
{
    if (a.trace || b.trace) return only_equal(a, b);
    if ((a.bits_per_second > 0) != (b.bits_per_second > 0)) return std::nullopt;
    return base::between(a, b, progress);
}

/// Returns the reason why there is nothing between `a` and `b`. The reason follows the key of the
/// setting.
template <typename Value>
std::string obstacle(const Value&, const Value&)
{
    return " between these values";
}

std::string obstacle(const Variation& a, const Variation& b)
{
    if (!is_nothing(a) && !is_nothing(b)) return " to a different law";
    const auto name = [](const Variation& one) {
        return is_nothing(one) ? std::string_view{"none"} : name_of(one.law);
    };
    return fmt::format(" from {} to {}: only constant, uniform and normal begin or end at none",
                       name(a), name(b));
}

std::string obstacle(const std::vector<LossLaw>& a, const std::vector<LossLaw>& b)
{
    if (!a.empty() && !b.empty()) return " to a different law";
    return fmt::format(" {} none: only one law, random, begins or ends at none",
                       a.empty() ? "from" : "to");
}

std::string obstacle(const Rate& a, const Rate& b)
{
    return a.trace || b.trace ? " from or to a trace" : " from or to none";
}
std::string obstacle(const Mtu&, const Mtu&) { return ""; }
std::string obstacle(const QueueControl&, const QueueControl&) { return ""; }
std::string obstacle(const Regimes&, const Regimes&) { return ""; }
std::string obstacle(Order, Order) { return ""; }

} // namespace

base::Result<void> validate_ramp(const Conditions& from, const Patch& to)
{
    base::Result<void> valid;
    for_each_setting([&](const auto& slot) {
        if (!valid || !(to.*slot.patch) || between(from.*slot.value, *(to.*slot.patch), 0.5))
            return;
        valid = base::fail(fmt::format("cannot ramp {}{}; use an [[at]] step without ramp",
                                       slot.key, obstacle(from.*slot.value, *(to.*slot.patch))));
    });
    return valid;
}

Conditions ramped(Conditions conditions, const Conditions& from, const Patch& to, double progress)
{
    for_each_setting([&](const auto& slot) {
        if (!(to.*slot.patch)) return;
        auto value = between(from.*slot.value, *(to.*slot.patch), progress);
        base::ensure(value.has_value());
        conditions.*slot.value = *std::move(value);
    });
    return conditions;
}

} // namespace hapnet::emulator
