// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/replay_rows.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab {

namespace {

constexpr std::size_t replay_columns = 15;

void append_side(std::string& out, const Sample& sample)
{
    constexpr double mm = 1e3;
    fmt::format_to(std::back_inserter(out), ",{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.4f}",
                   mm * sample.body.x(), mm * sample.body.y(), mm * sample.body.z(),
                   mm * sample.hip.x(), mm * sample.hip.y(), mm * sample.hip.z(),
                   sample.on_hand.x());
}

} // namespace

std::string replay_rows(const Trace& trace, std::uint32_t rows_per_s)
{
    std::string out;
    if (rows_per_s == 0) return out;
    const auto interval = base::Duration{std::chrono::seconds{1}} / rows_per_s;
    const auto every = static_cast<std::size_t>(std::max<std::int64_t>(interval / trace.tick, 1));
    for (std::size_t i = 0; i < trace.sides[0].size(); i += every) {
        const auto time = trace.begin + static_cast<std::int64_t>(i) * trace.tick;
        out += fmt::format("{:.4f}", base::to_seconds(time));
        append_side(out, trace.sides[0][i]);
        append_side(out, trace.sides[1][i]);
        out += '\n';
    }
    return out;
}

std::string trajectory_rows(std::string_view replay_rows, std::string_view algorithm)
{
    std::string out;
    while (!replay_rows.empty()) {
        auto line = replay_rows.substr(0, replay_rows.find('\n'));
        replay_rows.remove_prefix(std::min(line.size() + 1, replay_rows.size()));
        std::array<std::string_view, replay_columns> cells;
        for (std::string_view& cell : cells) {
            cell = line.substr(0, line.find(','));
            line.remove_prefix(std::min(cell.size() + 1, line.size()));
        }
        out += fmt::format("{},{},{},{},{},{},{},{}\n", algorithm, cells[0], cells[1], cells[8],
                           cells[4], cells[11], cells[7], cells[14]);
    }
    return out;
}

} // namespace hapnet::lab
