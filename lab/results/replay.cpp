// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/replay.hpp"

#include "lab/results/table_text.hpp"
#include "proto/base/csv.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::results {

namespace {

constexpr double mm_per_m = 1e3;
constexpr double m_per_mm = 1e-3;

std::vector<Column> replay_columns()
{
    return columns_in("time_s:4,lx:3,ly:3,lz:3,lhx:3,lhy:3,lhz:3,lfx:4,"
                      "rx:3,ry:3,rz:3,rhx:3,rhy:3,rhz:3,rfx:4");
}

ReplaySide side_of(const Rows& rows, char letter)
{
    ReplaySide side{.name = letter == 'l' ? "L" : "R", .is_left = letter == 'l', .bodies = {{}}};
    for (const TableRow& row : rows) {
        const auto number = [&](std::string_view key) {
            return row.number(fmt::format("{}{}", letter, key)).value_or(0.0);
        };
        side.hand_mm.emplace_back(number("hx"), number("hy"), number("hz"));
        side.force_n.emplace_back(number("fx"), 0.0, 0.0);
        const glm::dvec3 cube_mm{number("x"), number("y"), number("z")};
        side.bodies[0].push_back({{m_per_mm * cube_mm}});
    }
    return side;
}

} // namespace

Table replay_table(const virtual_time::Trace& trace, std::uint32_t rows_per_s)
{
    Table table{"replay", replay_columns()};
    if (rows_per_s == 0) return table;
    const auto interval = base::Duration{std::chrono::seconds{1}} / rows_per_s;
    const auto every = static_cast<std::size_t>(std::max<std::int64_t>(interval / trace.tick, 1));
    for (std::size_t i = 0; i < trace.sides[0].size(); i += every) {
        const auto time = trace.begin + static_cast<std::int64_t>(i) * trace.tick;
        auto& cells = table.rows.emplace_back();
        cells.emplace_back(base::to_seconds(time));
        for (const std::size_t number : {0U, 1U}) {
            const virtual_time::Sample& side = trace.sides[number][i];
            for (const glm::dvec3& metres : {side.body.value, side.hip.value})
                for (const double value : {metres.x, metres.y, metres.z})
                    cells.emplace_back(mm_per_m * value);
            cells.emplace_back(side.on_hand.x());
        }
    }
    return table;
}

std::string kept_lines(const Table& replay)
{
    std::string lines;
    for (std::size_t row = 0; row < replay.rows.size(); ++row)
        lines += csv_line(replay, row) + '\n';
    return lines;
}

Table from_kept_lines(std::string name, std::string_view lines)
{
    Table table{std::move(name), replay_columns()};
    const auto parsed =
        base::parse_csv(fmt::format("{}\n{}", csv_header(table.columns), lines), "kept rows");
    if (!parsed) return table;
    for (const base::CsvTable::Line& line : parsed->lines) {
        auto& cells = table.rows.emplace_back();
        for (const std::string& text : line.cells) {
            double number = 0.0;
            cells.push_back(base::read_cell(text, number) ? Cell{number} : Cell{});
        }
    }
    return table;
}

std::size_t first_movable(const scene::Description& scene)
{
    const auto body = std::ranges::find_if(scene.bodies, &scene::BodyDescription::movable);
    return static_cast<std::size_t>(body - scene.bodies.begin());
}

std::vector<ReplaySide> replay_sides(const virtual_time::Trace& trace,
                                     std::span<const std::string> names, std::size_t every)
{
    std::vector<ReplaySide> sides;
    for (std::size_t number = 0; number < trace.sides.size(); ++number) {
        ReplaySide& side = sides.emplace_back();
        side.name = names[number];
        side.is_left = number % 2 == 0;
        side.bodies.resize(trace.further_bodies + 1);
        const auto& samples = trace.sides[number];
        for (std::size_t i = 0; i < samples.size(); i += every) {
            side.hand_mm.push_back(mm_per_m * samples[i].hip.value);
            side.force_n.push_back(samples[i].on_hand.value);
            side.bodies[0].push_back({samples[i].body, samples[i].orientation});
            for (std::size_t body = 1; body <= trace.further_bodies; ++body) {
                side.bodies[body].push_back(
                    trace.further[number][i * trace.further_bodies + body - 1]);
            }
        }
    }
    return sides;
}

base::Result<Replay> replay_of(const Table& table)
{
    const Rows rows = rows_of(table);
    if (rows.size() < 2) return base::fail(table.name + ": expected two rows at least");
    const std::string_view words = std::string_view{table.name}.substr(table.name.rfind('/') + 1);
    const auto dash = std::min(words.rfind('-'), words.size());
    Replay replay{.algorithm = std::string{words.substr(0, dash)},
                  .task = std::string{words.substr(std::min(dash + 1, words.size()))},
                  .start_s = rows.front().number("time_s").value_or(0.0)};
    const double length_s = rows.back().number("time_s").value_or(0.0) - replay.start_s;
    replay.step_s = length_s / static_cast<double>(rows.size() - 1);
    replay.sides = {side_of(rows, 'l'), side_of(rows, 'r')};
    replay.shared = {first_movable(replay.scene)};
    return replay;
}

} // namespace hapnet::lab::results
