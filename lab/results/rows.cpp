// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/rows.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::results {

namespace {

/// L and R, and the body that they share.
std::vector<ReplaySide> sides_of(const std::vector<ReplayRow>& rows)
{
    constexpr double m_per_mm = 1e-3;
    std::vector<ReplaySide> sides{{.name = "L", .bodies = {{}}},
                                  {.name = "R", .is_left = false, .bodies = {{}}}};
    for (const ReplayRow& row : rows) {
        sides[0].hand_mm.push_back({row.lhx, row.lhy, row.lhz});
        sides[0].force_n.push_back({row.lfx, 0.0, 0.0});
        sides[0].bodies[0].push_back({{m_per_mm * glm::dvec3{row.lx, row.ly, row.lz}}});
        sides[1].hand_mm.push_back({row.rhx, row.rhy, row.rhz});
        sides[1].force_n.push_back({row.rfx, 0.0, 0.0});
        sides[1].bodies[0].push_back({{m_per_mm * glm::dvec3{row.rx, row.ry, row.rz}}});
    }
    return sides;
}

} // namespace

std::vector<ReplayRow> make_replay_rows(const virtual_time::Trace& trace, std::uint32_t rows_per_s)
{
    constexpr double mm = 1e3;
    std::vector<ReplayRow> rows;
    if (rows_per_s == 0) return rows;
    const auto interval = base::Duration{std::chrono::seconds{1}} / rows_per_s;
    const auto every = static_cast<std::size_t>(std::max<std::int64_t>(interval / trace.tick, 1));
    for (std::size_t i = 0; i < trace.sides[0].size(); i += every) {
        const auto time = trace.begin + static_cast<std::int64_t>(i) * trace.tick;
        const virtual_time::Sample &l = trace.sides[0][i], &r = trace.sides[1][i];
        rows.push_back({.time_s = base::to_seconds(time),
                        .lx = mm * l.body.x(),
                        .ly = mm * l.body.y(),
                        .lz = mm * l.body.z(),
                        .lhx = mm * l.hip.x(),
                        .lhy = mm * l.hip.y(),
                        .lhz = mm * l.hip.z(),
                        .lfx = l.on_hand.x(),
                        .rx = mm * r.body.x(),
                        .ry = mm * r.body.y(),
                        .rz = mm * r.body.z(),
                        .rhx = mm * r.hip.x(),
                        .rhy = mm * r.hip.y(),
                        .rhz = mm * r.hip.z(),
                        .rfx = r.on_hand.x()});
    }
    return rows;
}

std::string to_lines(const std::vector<ReplayRow>& rows)
{
    std::string lines;
    for (const ReplayRow& row : rows) lines += base::csv_line(row) + '\n';
    return lines;
}

std::size_t first_movable(const scene::Description& scene)
{
    const auto body = std::ranges::find_if(scene.bodies, &scene::BodyDescription::movable);
    return static_cast<std::size_t>(body - scene.bodies.begin());
}

std::vector<ReplaySide> replay_sides(const virtual_time::Trace& trace,
                                     std::span<const std::string> names, std::size_t every)
{
    constexpr double mm = 1e3;
    std::vector<ReplaySide> sides;
    for (std::size_t number = 0; number < trace.sides.size(); ++number) {
        ReplaySide& side = sides.emplace_back();
        side.name = names[number];
        side.is_left = number % 2 == 0;
        side.bodies.resize(trace.further_bodies + 1);
        const auto& samples = trace.sides[number];
        for (std::size_t i = 0; i < samples.size(); i += every) {
            side.hand_mm.push_back(mm * samples[i].hip.value);
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

TrajectoryRow to_trajectory(const std::string& algorithm, const ReplayRow& row)
{
    return {algorithm, row.time_s, row.lx, row.rx, row.lhx, row.rhx, row.lfx, row.rfx};
}

base::Result<void> require_increasing(const std::vector<TrajectoryRow>& rows)
{
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const TrajectoryRow &before = rows[i - 1], &row = rows[i];
        if (row.algorithm != before.algorithm || row.time_s > before.time_s) continue;
        return base::fail(fmt::format("trajectories: time_s: expected more than {}, found {}",
                                      before.time_s, row.time_s));
    }
    return {};
}

base::Result<Replay> replay_of(std::string_view name, const std::vector<ReplayRow>& rows)
{
    if (rows.size() < 2) return base::fail(fmt::format("{}: expected two rows at least", name));
    std::string_view words = name.substr(name.rfind('/') + 1);
    const auto dash = std::min(words.rfind('-'), words.size());
    Replay replay{.algorithm = std::string{words.substr(0, dash)},
                  .task = std::string{words.substr(std::min(dash + 1, words.size()))},
                  .start_s = rows.front().time_s};
    const auto steps = static_cast<double>(rows.size() - 1);
    replay.step_s = (rows.back().time_s - replay.start_s) / steps;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double time_s = rows[i].time_s;
        const double expected = replay.start_s + static_cast<double>(i) * replay.step_s;
        if (replay.step_s > 0.0 && std::abs(time_s - expected) <= 0.5 * replay.step_s) continue;
        return base::fail(
            fmt::format("{}: time_s: expected equal steps and so {:.4f}, found {:.4f}", name,
                        expected, time_s));
    }
    replay.sides = sides_of(rows);
    replay.shared = {first_movable(replay.scene)};
    return replay;
}

} // namespace hapnet::lab::results
