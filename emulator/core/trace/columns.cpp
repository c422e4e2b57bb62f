// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/trace/columns.hpp"

#include "emulator/core/delay/bounds.hpp"

#include <array>

namespace hapnet::emulator {

namespace {

using base::ColumnKind;
using base::ColumnUnit;

constexpr std::array<ColumnUnit, 4> time_units{{{"ns", 1.0}, {"us", 1e3}, {"ms", 1e6}, {"s", 1e9}}};
constexpr std::array<ColumnUnit, 3> share_units{{{"share", 1.0}, {"percent", 0.01}, {"%", 0.01}}};
constexpr std::array<ColumnUnit, 10> rate_units{{{"bps", 1.0},
                                                 {"kbps", 1e3},
                                                 {"Mbps", 1e6},
                                                 {"mbps", 1e6},
                                                 {"Gbps", 1e9},
                                                 {"gbps", 1e9},
                                                 {"bit/s", 1.0},
                                                 {"kbit/s", 1e3},
                                                 {"Mbit/s", 1e6},
                                                 {"Gbit/s", 1e9}}};
constexpr double most_time = 1e19; // times may count from an epoch, as the first one is subtracted
constexpr ColumnKind time_kind{.what = "time",
                               .units = time_units,
                               .most = most_time,
                               .most_text = "too long",
                               .short_name = "t",
                               .is_optional = true};

ColumnKind kind_of(Measure measure)
{
    switch (measure) {
    case Measure::delay:
        return {.what = "delay",
                .units = time_units,
                .most = static_cast<double>(longest_delay.count()),
                .most_text = "longer than 10^6 s",
                .may_stand_alone = true,
                .usual_names = "delay_ns, delay_us, delay_ms or delay_s",
                .example_unit = ":ms"};
    case Measure::loss:
        return {.what = "loss",
                .units = share_units,
                .bare_factor = 1.0,
                .most = 1.0,
                .most_text = "more than all",
                .usual_names = "loss or loss_percent",
                .example_unit = ":share"};
    case Measure::lost:
        return {.what = "lost",
                .bare_factor = 1.0,
                .most = 1.0,
                .most_text = "neither 0 (arrived) nor 1 (lost)",
                .usual_names = "lost"};
    case Measure::rate: break;
    }
    return {.what = "rate",
            .units = rate_units,
            .most = 1e12,
            .most_text = "more than 1 Tbit/s",
            .usual_names = "rate_bps, rate_kbps, rate_Mbps or rate_Gbps",
            .example_unit = ":Mbps"};
}

} // namespace

std::string_view name_of(Measure measure) { return kind_of(measure).what; }

base::Result<base::Columns> parse_columns(std::string_view text)
{
    constexpr std::array<std::string_view, 5> known{"time", "delay", "loss", "lost", "rate"};
    return base::parse_columns(text, known);
}

base::Result<base::TableLayout> find_layout(const base::LineReader& lines, Measure measure,
                                            const base::Columns& columns)
{
    const std::array kinds{kind_of(measure), time_kind};
    return base::find_layout(lines, kinds, columns);
}

} // namespace hapnet::emulator
