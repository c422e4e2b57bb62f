// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/law.hpp"

#include "emulator/core/delay/gamma.hpp"
#include "emulator/core/delay/table.hpp"
#include "emulator/core/delay/trace.hpp"
#include "proto/base/ensure.hpp"

#include <cmath>
#include <initializer_list>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::emulator {

namespace {

using Objection = std::optional<std::string>;
constexpr base::Duration no_delay{};

Objection unless(bool condition, std::string_view words)
{
    if (condition) return std::nullopt;
    return std::string{words};
}

Objection not_negative(base::Duration duration, std::string_view name)
{
    if (duration >= no_delay) return std::nullopt;
    return fmt::format("{} must not be negative", name);
}

Objection in_range(base::Duration duration, std::string_view name)
{
    if (duration >= -longest_delay && duration <= longest_delay) return std::nullopt;
    return fmt::format("{} must be at most 10^6 s", name);
}

Objection any(std::initializer_list<Objection> objections)
{
    for (const Objection& objection : objections) {
        if (objection) return objection;
    }
    return std::nullopt;
}

Objection object(const ConstantLaw& law) { return in_range(law.value, "value"); }

Objection object(const UniformLaw& law)
{
    return any({in_range(law.mean, "mean"), not_negative(law.half_width, "half_width"),
                in_range(law.half_width, "half_width")});
}

Objection object(const NormalLaw& law)
{
    return any({in_range(law.mean, "mean"), not_negative(law.sd, "sd"), in_range(law.sd, "sd")});
}

Objection object(const LogNormalLaw& law)
{
    return any({in_range(law.mean, "mean"), not_negative(law.sd, "sd"), in_range(law.sd, "sd"),
                unless(law.mean > no_delay, "mean must be more than 0")});
}

Objection object(const ExponentialLaw& law)
{
    return any({in_range(law.mean, "mean"), not_negative(law.mean, "mean")});
}

Objection object(const ParetoLaw& law)
{
    return any({in_range(law.mean, "mean"), not_negative(law.mean, "mean"),
                unless(law.shape > 1.0 && std::isfinite(law.shape),
                       "shape must be more than 1, or there is no mean")});
}

Objection object(const GammaLaw& law)
{
    static_assert(GammaQuantile::shape_min == 0.01);
    return any({in_range(law.mean, "mean"), in_range(law.sd, "sd"),
                unless(law.mean > no_delay, "mean must be more than 0"),
                unless(law.sd > no_delay, "sd must be more than 0"),
                unless(law.sd <= 10 * law.mean, "sd must be at most 10 times the mean")});
}

Objection object(const TableLaw& law)
{
    base::ensure(law.table != nullptr);
    const bool is_as_measured =
        law.table->holds_delays() && law.mean == no_delay && law.sd == no_delay;
    return any({in_range(law.mean, "mean"), not_negative(law.sd, "sd"), in_range(law.sd, "sd"),
                unless(law.sd > no_delay || is_as_measured, "sd must be more than 0"),
                unless(law.sd == no_delay || law.table->sd() > 0.0,
                       "the values of the table are all the same: they cannot have this sd")});
}

Objection object(const TraceLaw& law)
{
    base::ensure(law.trace != nullptr);
    return std::nullopt;
}

/// By what they hold: the same file read twice is the same law.
template <typename T>
bool same(const std::shared_ptr<const T>& a, const std::shared_ptr<const T>& b)
{
    return a == b || (a && b && *a == *b);
}

} // namespace

bool operator==(const TableLaw& a, const TableLaw& b)
{
    return a.file == b.file && a.mean == b.mean && a.sd == b.sd && same(a.table, b.table);
}

bool operator==(const TraceLaw& a, const TraceLaw& b)
{
    return a.file == b.file && same(a.trace, b.trace);
}

std::optional<std::string> objection(const Variation& variation)
{
    const bool is_trace = std::holds_alternative<TraceLaw>(variation.law);
    return any({std::visit([](const auto& law) { return object(law); }, variation.law),
                not_negative(variation.correlation_time, "correlation_time"),
                unless(!is_trace || variation.correlation_time == no_delay,
                       "correlation_time is not for traces: they are correlated as recorded")});
}

bool is_nothing(const Variation& variation)
{
    if (const auto* constant = std::get_if<ConstantLaw>(&variation.law)) {
        return constant->value == no_delay;
    }
    if (const auto* uniform = std::get_if<UniformLaw>(&variation.law)) {
        return uniform->mean == no_delay && uniform->half_width == no_delay;
    }
    return false;
}

} // namespace hapnet::emulator
