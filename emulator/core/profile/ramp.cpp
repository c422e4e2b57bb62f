// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/ramp.hpp"

#include "emulator/core/profile/form.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <type_traits>

namespace hapnet::emulator {

namespace {

// between(a, b, progress): the point between two values; nullopt when there is none. Where the
// parameters of a law bound each other, the bounds are convex: between possible laws all are.

template <typename T>
std::optional<T> only_equal(const T& a, const T& b)
{
    return a == b ? std::optional{b} : std::nullopt;
}

std::optional<double> between(double a, double b, double progress)
{
    return a + (b - a) * progress;
}

std::optional<base::Duration> between(base::Duration a, base::Duration b, double progress)
{
    return a + base::Duration{std::llround(static_cast<double>((b - a).count()) * progress)};
}

std::optional<base::Probability> between(base::Probability a, base::Probability b, double progress)
{
    const double fraction = a.fraction() + (b.fraction() - a.fraction()) * progress;
    return base::Probability::from_fraction(std::clamp(fraction, 0.0, 1.0));
}

template <typename Whole>
requires std::is_unsigned_v<Whole> std::optional<Whole> between(Whole a, Whole b, double progress)
{
    const auto from = static_cast<double>(a);
    return static_cast<Whole>(std::llround(from + (static_cast<double>(b) - from) * progress));
}

std::optional<std::uint8_t> between(std::uint8_t a, std::uint8_t b, double)
{
    return only_equal(a, b);
}

template <typename T>
std::optional<std::optional<T>> between(const std::optional<T>& a, const std::optional<T>& b,
                                        double progress)
{
    if (!a || !b) return only_equal(a, b);
    const auto value = between(*a, *b, progress);
    return value ? std::optional{std::optional{*value}} : std::nullopt;
}

std::optional<std::variant<base::Duration, std::uint32_t>>
between(const std::variant<base::Duration, std::uint32_t>& a,
        const std::variant<base::Duration, std::uint32_t>& b, double progress)
{
    if (a.index() != b.index()) return std::nullopt;
    if (const auto* time = std::get_if<base::Duration>(&a)) {
        return *between(*time, std::get<base::Duration>(b), progress);
    }
    return *between(std::get<std::uint32_t>(a), std::get<std::uint32_t>(b), progress);
}

std::optional<Displacement> between(const Displacement& a, const Displacement& b, double progress)
{
    if ((a.places > 0) != (b.places > 0)) return std::nullopt;
    return Displacement{*between(a.places, b.places, progress), *between(a.time, b.time, progress)};
}

std::optional<std::string> between(const std::string& a, const std::string& b, double)
{
    return only_equal(a, b);
}

template <typename T>
std::optional<std::vector<T>> between(const std::vector<T>& a, const std::vector<T>& b, double)
{
    return only_equal(a, b);
}

template <typename T>
std::optional<T> between_fields(const T& a, const T& b, double progress)
{
    T result = b;
    bool is_possible = true;
    const auto set = [&](const auto& field) {
        const auto value = between(a.*field.member, b.*field.member, progress);
        is_possible = is_possible && value.has_value();
        if (value) result.*field.member = *value;
    };
    std::apply([&](const auto&... fields) { (set(fields), ...); }, Form<T>::fields);
    return is_possible ? std::optional{result} : std::nullopt;
}

/// Its bounds are not convex.
std::optional<FourState> between_fields(const FourState& a, const FourState& b, double)
{
    return only_equal(a, b);
}

/// Delays taken as they were measured have no mean and sd to go from or to.
std::optional<TableLaw> between_fields(const TableLaw& a, const TableLaw& b, double progress)
{
    const base::Duration as_measured{0};
    if ((a.sd == as_measured) != (b.sd == as_measured)) return std::nullopt;
    return between_fields<TableLaw>(a, b, progress);
}

template <typename Law>
std::optional<Law> between_laws(const Law& a, const Law& b, double progress)
{
    if (a.index() != b.index()) return std::nullopt;
    return std::visit(
        [&](const auto& to) -> std::optional<Law> {
            using Own = std::decay_t<decltype(to)>;
            const auto law = between_fields(std::get<Own>(a), to, progress);
            return law ? std::optional<Law>{*law} : std::nullopt;
        },
        b);
}

/// Nothing, as a law of the kind of `other`, where that can be nothing.
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
    const auto time = between(is_nothing(a) ? b.correlation_time : a.correlation_time,
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

/// A share of zero goes with whatever else the other one says.
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
    return between_fields(a, b, progress);
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

std::optional<Order> between(Order a, Order b, double) { return only_equal(a, b); }

std::optional<Rate> between(const Rate& a, const Rate& b, double progress)
{
    if ((a.bits_per_second > 0) != (b.bits_per_second > 0)) return std::nullopt;
    return between_fields(a, b, progress);
}

/// Calls use(key, from, to) for what the patch sets.
template <typename Use>
void for_each_set(const Conditions& from, const Patch& to, Use use)
{
    const auto one = [&](std::string_view key, auto member, auto patch_member) {
        if (to.*patch_member) use(key, member, from.*member, *(to.*patch_member));
    };
    one("mtu", &Conditions::mtu, &Patch::mtu);
    one("rate", &Conditions::rate, &Patch::rate);
    one("loss", &Conditions::loss, &Patch::loss);
    one("corrupt", &Conditions::corrupt, &Patch::corrupt);
    one("duplicate", &Conditions::duplicate, &Patch::duplicate);
    one("delay", &Conditions::delay, &Patch::delay);
    one("jitter", &Conditions::jitter, &Patch::jitter);
    one("order", &Conditions::order, &Patch::order);
    one("reorder", &Conditions::reorder, &Patch::reorder);
}

} // namespace

std::optional<std::string> ramp_fault(const Conditions& from, const Patch& to)
{
    std::optional<std::string> fault;
    for_each_set(from, to, [&](std::string_view key, auto, const auto& before, const auto& after) {
        if (fault || between(before, after, 0.5)) return;
        fault = fmt::format("{} has no straight way from what held before to this: a "
                            "ramp is for numbers of the same law; change other things "
                            "without ramp",
                            key);
    });
    return fault;
}

Conditions ramped(Conditions conditions, const Conditions& from, const Patch& to, double progress)
{
    for_each_set(from, to,
                 [&](std::string_view, auto member, const auto& before, const auto& after) {
                     auto value = between(before, after, progress);
                     base::ensure(value.has_value());
                     conditions.*member = *std::move(value);
                 });
    return conditions;
}

} // namespace hapnet::emulator
