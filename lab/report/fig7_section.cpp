// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

constexpr std::size_t points_max = 6000; // a curve: finer than pixels even when zoomed
constexpr std::string_view left_colour = "left";
constexpr std::string_view right_colour = "right";

using Rows = std::vector<results::TrajectoryRow>;

std::vector<page::Point> points_of(const Rows& rows, double results::TrajectoryRow::*value)
{
    std::vector<page::Point> points;
    for (const results::TrajectoryRow& row : rows) points.push_back({row.time_s, row.*value});
    return page::thinned(points, points_max);
}

/// What is drawn of both sides over time.
struct BothSides {
    std::string_view title; // after the algorithm's name
    std::string_view left_name;
    std::string_view right_name;
    std::string_view unit;
    double results::TrajectoryRow::*left;
    double results::TrajectoryRow::*right;
};

constexpr BothSides drawn_cubes{"",
                                "cube at L",
                                "cube at R",
                                "mm",
                                &results::TrajectoryRow::cube_l_mm,
                                &results::TrajectoryRow::cube_r_mm};
constexpr BothSides drawn_hands{": hands",
                                "hand L",
                                "hand R",
                                "mm",
                                &results::TrajectoryRow::hand_l_mm,
                                &results::TrajectoryRow::hand_r_mm};
constexpr BothSides drawn_forces{": forces",
                                 "on hand L",
                                 "on hand R",
                                 "N",
                                 &results::TrajectoryRow::force_l_n,
                                 &results::TrajectoryRow::force_r_n};

page::Figure over_time(std::string id, std::string title, std::string_view unit,
                       std::vector<page::Curve> curves, const page::Range& range)
{
    return {.id = page::plain_id(std::move(id)),
            .title = std::move(title),
            .x = {"time", "s"},
            .y = {"x", std::string{unit}, page::Scale::linear, range},
            .content = page::Curves{std::move(curves)},
            .size = {900.0, 230.0}};
}

page::Figure both_sides_figure(std::string_view id, const Rows& rows, const BothSides& both,
                               const page::Range& range = {})
{
    const std::string& algorithm = rows.front().algorithm;
    auto figure = over_time(fmt::format("{}-{}", id, algorithm),
                            algorithm + std::string{both.title}, both.unit,
                            {{.name = std::string{both.left_name},
                              .colour = left_colour,
                              .points = points_of(rows, both.left)},
                             {.name = std::string{both.right_name},
                              .colour = right_colour,
                              .points = points_of(rows, both.right)}},
                            range);
    figure.caption = algorithm;
    return figure;
}

/// x_L - x_R, where two curves that lie on each other cannot be told apart.
page::Figure difference_figure(const Rows& rows, const page::Range& range)
{
    std::vector<page::Point> points;
    for (const results::TrajectoryRow& row : rows)
        points.push_back({row.time_s, row.cube_l_mm - row.cube_r_mm});
    const std::string& algorithm = rows.front().algorithm;
    auto figure = over_time("fig7-difference-" + algorithm, algorithm + ": difference", "mm",
                            {{.name = "x of the cube at L − at R",
                              .colour = colour_of(algorithm),
                              .points = page::thinned(points, points_max)}},
                            range);
    figure.size.height = 170.0;
    figure.caption = algorithm + ": the copies’ difference, on one scale for all.";
    return figure;
}

/// What one sees: how a copy moves that follows.
std::string steps_text(const Rows& rows)
{
    constexpr double step_mm = 5.0; // no hand moves a cube so far between two rows
    std::size_t steps = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const double left = std::abs(rows[i].cube_l_mm - rows[i - 1].cube_l_mm);
        const double right = std::abs(rows[i].cube_r_mm - rows[i - 1].cube_r_mm);
        if (left > step_mm || right > step_mm) ++steps;
    }
    if (steps == 0) return " No copy jumps by more than 5 mm from one row to the next.";
    return fmt::format(" A copy jumps by more than 5 mm from one row to the next {} times: it "
                       "moves vigorously, and does not follow the curve of the other.",
                       steps);
}

std::string apart_text(const Rows& rows)
{
    double sum = 0.0, most = 0.0;
    for (const results::TrajectoryRow& row : rows) {
        const double apart = std::abs(row.cube_l_mm - row.cube_r_mm);
        sum += apart;
        most = std::max(most, apart);
    }
    return fmt::format("{}: the copies are {} mm apart on average and {} mm at most.",
                       rows.front().algorithm, shown(sum / static_cast<double>(rows.size()), 2),
                       shown(most, 1)) +
           steps_text(rows);
}

} // namespace

std::optional<Section> fig7_section(const results::Results& results)
{
    if (results.trajectories.empty()) return std::nullopt;
    Section section{"fig7", "Fig. 7: where each side has the cube"};
    section.sources = files_named(results, "trajectories.csv");
    page::Range range, apart;
    for (const results::TrajectoryRow& row : results.trajectories) {
        range.include(row.cube_l_mm);
        range.include(row.cube_r_mm);
        apart.include(row.cube_l_mm - row.cube_r_mm);
    }
    Json blocks = Json::array(), more = Json::array();
    for (const auto& name :
         distinct(results.trajectories, [](const auto& r) { return r.algorithm; })) {
        const Rows rows = rows_where(results.trajectories,
                                     [&](const auto& row) { return row.algorithm == name; });
        auto cubes = both_sides_figure("fig7", rows, drawn_cubes, range);
        cubes.caption = apart_text(rows);
        blocks.push_back(section.keep(std::move(cubes)));
        blocks.push_back(section.keep(difference_figure(rows, apart)));
        more.push_back(section.keep(both_sides_figure("fig7-hands", rows, drawn_hands)));
        more.push_back(section.keep(both_sides_figure("fig7-forces", rows, drawn_forces)));
    }
    blocks.push_back(page::folded("Hands and forces", std::move(more)));
    section.add(page::zoomed(std::move(blocks)));
    return section;
}

} // namespace hapnet::lab::report
