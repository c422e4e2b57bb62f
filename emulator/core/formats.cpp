// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/formats.hpp"

#include "proto/base/ramp.hpp"

namespace hapnet::emulator {

void TimeOrCount::read(const base::Node& node, Value& target, base::Reading& reading) const
{
    if (std::holds_alternative<std::int64_t>(node.value)) {
        std::uint32_t count = 0;
        base::read_value(node, count, reading);
        target = count;
    } else {
        base::Duration time{};
        base::read_value(node, time, reading);
        target = time;
    }
}

std::string TimeOrCount::print(const Value& value) const
{
    return std::visit([](const auto& one) { return base::value_text(one); }, value);
}

void DisplacementFormat::read(const base::Node& node, Displacement& target,
                              base::Reading& reading) const
{
    TimeOrCount::Value value;
    TimeOrCount{}.read(node, value, reading);
    target = {};
    if (const auto* places = std::get_if<std::uint32_t>(&value)) target.places = *places;
    if (const auto* time = std::get_if<base::Duration>(&value)) target.time = *time;
}

std::string DisplacementFormat::print(const Displacement& value) const
{
    return value.places > 0 ? base::value_text(value.places) : base::value_text(value.time);
}

std::optional<Displacement> between(const Displacement& a, const Displacement& b, double progress)
{
    if ((a.places > 0) != (b.places > 0)) return std::nullopt;
    return Displacement{*base::between(a.places, b.places, progress),
                        *base::between(a.time, b.time, progress)};
}

} // namespace hapnet::emulator
