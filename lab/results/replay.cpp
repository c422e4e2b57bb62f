// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/replay.hpp"

#include "lab/results/table_text.hpp"
#include "peer/core/shared_body.hpp"
#include "proto/base/csv.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::results {

namespace {

constexpr double mm_per_m = 1e3;
constexpr double m_per_mm = 1e-3;

constexpr std::size_t plain_columns = 15;
constexpr std::size_t turn_columns = 4, pose_columns = 7; // columns for each body and side

/// Returns the columns of a replay. `further` is the number of further bodies where a body turns or
/// several are shared; nullopt: there are the plain columns only.
std::vector<Column> replay_columns(std::optional<std::size_t> further)
{
    std::string line = "time_s:4,lx:3,ly:3,lz:3,lhx:3,lhy:3,lhz:3,lfx:4,"
                       "rx:3,ry:3,rz:3,rhx:3,rhy:3,rhz:3,rfx:4";
    for (std::size_t body = 1; further && body <= *further + 1; ++body) {
        for (const char side : {'l', 'r'}) {
            const auto name = body == 1 ? std::string{side} : fmt::format("{}{}", side, body);
            if (body > 1) line += fmt::format(",{0}x:3,{0}y:3,{0}z:3", name);
            line += fmt::format(",{0}qw:5,{0}qx:5,{0}qy:5,{0}qz:5", name);
        }
    }
    return columns_in(line);
}

/// Returns the number of further bodies of a table with this number of columns; nullopt: it has the
/// plain ones.
std::optional<std::size_t> further_in(std::size_t columns)
{
    if (columns <= plain_columns) return std::nullopt;
    return ((columns - plain_columns) / 2 - turn_columns) / pose_columns;
}

bool turns(const virtual_time::Trace& trace)
{
    const auto is_turned = [](const virtual_time::Sample& sample) {
        return sample.orientation != glm::dquat{1.0, 0.0, 0.0, 0.0};
    };
    return std::ranges::any_of(
        trace.sides, [&](const auto& side) { return std::ranges::any_of(side, is_turned); });
}

void add_place(std::vector<Cell>& cells, const glm::dvec3& metres)
{
    for (const double value : {metres.x, metres.y, metres.z}) cells.emplace_back(mm_per_m * value);
}

void add_turn(std::vector<Cell>& cells, const glm::dquat& turn)
{
    for (const double value : {turn.w, turn.x, turn.y, turn.z}) cells.emplace_back(value);
}

ReplaySide side_of(const Rows& rows, char letter, std::optional<std::size_t> further)
{
    ReplaySide side{.name = letter == 'l' ? "A" : "B",
                    .is_left = letter == 'l',
                    .bodies =
                        std::vector<std::vector<virtual_time::Pose>>(further.value_or(0) + 1)};
    for (const TableRow& row : rows) {
        const auto number = [&](const std::string& key, double otherwise = 0.0) {
            return row.number(letter + key).value_or(otherwise);
        };
        side.hand_mm.emplace_back(number("hx"), number("hy"), number("hz"));
        side.force_n.emplace_back(number("fx"), 0.0, 0.0);
        for (std::size_t body = 0; body < side.bodies.size(); ++body) {
            const auto of = body == 0 ? std::string{} : std::to_string(body + 1);
            const glm::dvec3 mm{number(of + "x"), number(of + "y"), number(of + "z")};
            const glm::dquat turn{number(of + "qw", 1.0), number(of + "qx"), number(of + "qy"),
                                  number(of + "qz")};
            side.bodies[body].push_back({{m_per_mm * mm}, turn});
        }
    }
    return side;
}

} // namespace

Table replay_table(const virtual_time::Trace& trace, std::uint32_t rows_per_s)
{
    const bool is_plain = trace.further_bodies == 0 && !turns(trace);
    Table table{"replay",
                replay_columns(is_plain ? std::nullopt : std::optional{trace.further_bodies})};
    if (rows_per_s == 0) return table;
    const auto interval = base::Duration{std::chrono::seconds{1}} / rows_per_s;
    const auto every = static_cast<std::size_t>(std::max<std::int64_t>(interval / trace.tick, 1));
    for (std::size_t i = 0; i < trace.sides[0].size(); i += every) {
        const auto time = trace.begin + static_cast<std::int64_t>(i) * trace.tick;
        auto& cells = table.rows.emplace_back();
        cells.emplace_back(base::to_seconds(time));
        for (const std::size_t number : {0U, 1U}) {
            const virtual_time::Sample& side = trace.sides[number][i];
            add_place(cells, side.body.value);
            add_place(cells, side.hip.value);
            cells.emplace_back(side.on_hand.x());
        }
        if (is_plain) continue;
        for (const std::size_t number : {0U, 1U})
            add_turn(cells, trace.sides[number][i].orientation);
        for (std::size_t body = 0; body < trace.further_bodies; ++body) {
            for (const std::size_t number : {0U, 1U}) {
                const auto& pose = trace.further[number][i * trace.further_bodies + body];
                add_place(cells, pose.position.value);
                add_turn(cells, pose.orientation);
            }
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
    const auto first = lines.substr(0, lines.find('\n'));
    const auto count = static_cast<std::size_t>(std::ranges::count(first, ',')) + 1;
    Table table{std::move(name), replay_columns(further_in(count))};
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
    const auto further = further_in(table.columns.size());
    replay.sides = {side_of(rows, 'l', further), side_of(rows, 'r', further)};
    replay.shared = {first_movable(replay.scene)};
    return replay;
}

Table replay_scenes() { return {"replay_scenes", columns_in("replay,scene,toml+")}; }

bool set_scene(Replay& replay, const std::string& toml)
{
    const auto scene = scene::parse_scene(toml, "replay_scenes");
    if (!scene) return false;
    const auto bodies = peer::shared_bodies(*scene);
    if (!bodies || bodies->size() != replay.sides.front().bodies.size()) return false;
    std::vector<std::size_t> shared;
    for (const peer::SharedBody& body : *bodies) shared.push_back(body.id);
    replay.scene = *scene;
    replay.shared = std::move(shared);
    return true;
}

} // namespace hapnet::lab::results
