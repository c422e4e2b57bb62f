// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/measured_table.hpp"

#include "emulator/core/profile/text.hpp"
#include "proto/base/reading.hpp"

#include <algorithm>
#include <chrono>
#include <spdlog/fmt/fmt.h>
#include <utility>
#include <variant>

namespace hapnet::emulator::tools {

namespace {

/// Returns `file = "a.csv"`, and the other keys that the file needs.
std::string keys_of(const MeasuredTable& table)
{
    std::string keys = fmt::format("file = {}", base::quoted(table.file));
    if (!table.columns.empty()) keys += fmt::format(", columns = {}", base::quoted(table.columns));
    return keys;
}

std::string timed_keys_of(const MeasuredTable& table)
{
    if (table.slot == base::Duration{0}) return keys_of(table);
    return fmt::format("{}, slot = \"{}ns\"", keys_of(table), table.slot.count());
}

base::Result<Conditions> read(const std::string& down, const MeasuredTable& table)
{
    const OpenFile open = [&](const std::string& /*name*/) -> base::Result<std::string> {
        return table.text;
    };
    return parse_profile(fmt::format("[down]\n{}", down), table.file, open)
        .map([](const Profile& profile) { return profile.path.down; });
}

base::Duration::rep in_us(base::Duration time) { return time / std::chrono::microseconds{1}; }

} // namespace

std::string table_of(const MeasuredWay& way)
{
    std::string text = way.spacing ? "time_s,delay_ms\n" : "delay_ms\n";
    for (std::size_t i = 0; i < way.delays.size(); ++i) {
        if (way.spacing) {
            const auto at = *way.spacing * static_cast<base::Duration::rep>(i);
            text += fmt::format("{:.6f},", base::to_seconds(at));
        }
        const auto& delay = way.delays[i];
        text += delay ? fmt::format("{:.6g}\n", base::to_nanoseconds(*delay) / 1e6) : "lost\n";
    }
    return text;
}

MeasuredTable named_table(std::string file, const MeasuredWay& way)
{
    return {.file = std::move(file),
            .text = table_of(way),
            .is_timed = way.spacing.has_value(),
            .has_losses = std::ranges::find(way.lost, true) != way.lost.end()};
}

base::Result<Conditions> drawn_from(const MeasuredTable& table, base::Duration base,
                                    base::Duration correlation_time)
{
    auto as_measured =
        read(fmt::format("delay = {{ law = \"table\", {} }}", keys_of(table)), table);
    if (!as_measured) return as_measured;
    const auto& law = std::get<TableLaw>(as_measured->delay.law);
    const auto moments = law.moments();
    auto text = fmt::format("delay = \"{}us\"\njitter = {{ law = \"table\", {}, mean = \"{}us\", "
                            "sd = \"{}us\" }}\n",
                            in_us(base), keys_of(table), in_us(moments.mean - base),
                            in_us(moments.sd.value_or(base::Duration{0})));
    if (correlation_time > base::Duration{0})
        text += fmt::format("correlation_time = \"{}us\"\n", in_us(correlation_time));
    return read(text, table);
}

base::Result<Conditions> replayed(const MeasuredTable& table)
{
    auto text = fmt::format("delay = {{ law = \"trace\", {} }}\n", timed_keys_of(table));
    if (table.has_losses) {
        text +=
            fmt::format("loss = {{ law = \"{}\", {} }}\n", table.is_timed ? "timed-trace" : "trace",
                        table.is_timed ? timed_keys_of(table) : keys_of(table));
    }
    return read(text, table);
}

} // namespace hapnet::emulator::tools
