// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"
#include "proto/plot/plot.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

using plot::escaped;

namespace {

constexpr std::size_t points_max = 6000; // a curve: finer than pixels even when zoomed
constexpr std::string_view left_colour = "var(--left)";
constexpr std::string_view right_colour = "var(--right)";

using Rows = std::vector<results::TrajectoryRow>;

std::vector<plot::Point> points_of(const Rows& rows, double results::TrajectoryRow::*value)
{
    std::vector<plot::Point> points;
    for (const results::TrajectoryRow& row : rows) points.push_back({row.time_s, row.*value});
    return plot::thinned(points, points_max);
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
                                "x, mm",
                                &results::TrajectoryRow::cube_l_mm,
                                &results::TrajectoryRow::cube_r_mm};
constexpr BothSides drawn_hands{": hands",
                                "hand L",
                                "hand R",
                                "x, mm",
                                &results::TrajectoryRow::hand_l_mm,
                                &results::TrajectoryRow::hand_r_mm};
constexpr BothSides drawn_forces{": forces",
                                 "on hand L",
                                 "on hand R",
                                 "x, N",
                                 &results::TrajectoryRow::force_l_n,
                                 &results::TrajectoryRow::force_r_n};

Drawing both_sides_plot(const Rows& rows, const BothSides& both, const plot::Range& range = {})
{
    const std::array curves{plot::Curve{.name = both.left_name,
                                        .colour = left_colour,
                                        .points = points_of(rows, both.left)},
                            plot::Curve{.name = both.right_name,
                                        .colour = right_colour,
                                        .points = points_of(rows, both.right)}};
    const std::string title = rows.front().algorithm + std::string{both.title};
    return drawn_plot({title, "time, s", both.unit}, curves, {.size = {900.0, 230.0}, .y = range});
}

/// x_L - x_R, where two curves that lie on each other cannot be told apart.
Drawing difference_plot(const Rows& rows, const plot::Range& range)
{
    std::vector<plot::Point> points;
    for (const results::TrajectoryRow& row : rows)
        points.push_back({row.time_s, row.cube_l_mm - row.cube_r_mm});
    const std::array curves{plot::Curve{.name = "x of the cube at L − at R",
                                        .colour = colour_of(rows.front().algorithm),
                                        .points = plot::thinned(points, points_max)}};
    const std::string title = rows.front().algorithm + ": difference";
    return drawn_plot({title, "time, s", "x, mm"}, curves, {.size = {900.0, 170.0}, .y = range});
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
                       escaped(rows.front().algorithm),
                       shown(sum / static_cast<double>(rows.size()), 2), shown(most, 1)) +
           steps_text(rows);
}

} // namespace

std::optional<Section> fig7_section(const results::Results& results)
{
    if (results.trajectories.empty()) return std::nullopt;
    Section section{
        "fig7", "Fig. 7: where each side has the cube",
        "<div class='zoom-group'>\n<p class='zoom-help' hidden>Drag across a plot to zoom; "
        "all follow. <span class='zoom-buttons'></span></p>\n"};
    section.sources = links_to(results, "trajectories.csv");
    plot::Range range, apart;
    for (const results::TrajectoryRow& row : results.trajectories) {
        range.include(row.cube_l_mm);
        range.include(row.cube_r_mm);
        apart.include(row.cube_l_mm - row.cube_r_mm);
    }
    std::string more;
    for (const auto& name :
         distinct(results.trajectories, [](const auto& r) { return r.algorithm; })) {
        Rows rows;
        for (const results::TrajectoryRow& row : results.trajectories) {
            if (row.algorithm == name) rows.push_back(row);
        }
        section.add_figure("fig7-" + name, both_sides_plot(rows, drawn_cubes, range),
                           apart_text(rows));
        section.add_figure("fig7-difference-" + name, difference_plot(rows, apart),
                           escaped(name) + ": the copies’ difference, on one scale for all.");
        more += section.keep_figure("fig7-hands-" + name, both_sides_plot(rows, drawn_hands),
                                    escaped(name)) +
                section.keep_figure("fig7-forces-" + name, both_sides_plot(rows, drawn_forces),
                                    escaped(name));
    }
    section.html += folded("Hands and forces", more) + "</div>\n";
    return section;
}

} // namespace hapnet::lab::report
