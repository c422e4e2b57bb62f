// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/bodies.hpp"
#include "lab/report/figures.hpp"
#include "lab/report/patterns.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

using Values = std::vector<records::TimedValue>;

constexpr std::size_t curve_points_max = 4000; // a curve: finer than pixels, and no peak is lost
constexpr page::Size plot_size{900.0, 230.0};
/// Of the bodies of a session, in their order; there are eight at most.
constexpr std::array<std::string_view, 8> body_colours{"left",   "right", "sep",        "other",
                                                       "missed", "met",   "calibrated", "muted"};

page::Curve curve_of(std::string_view name, std::string_view colour, const Values& values)
{
    std::vector<page::Point> points;
    for (const records::TimedValue& one : values) points.push_back({one.time_s, one.value});
    return {.name = std::string{name},
            .colour = colour,
            .points = page::thinned(points, curve_points_max)};
}

/// The first and the last time of what is drawn: all plots of a session span the same.
page::Range span_of(const records::SessionCurves& curves)
{
    page::Range range;
    for (const auto* values : {&curves.cube_a_mm, &curves.cube_b_mm}) {
        if (values->empty()) continue;
        range.include(values->front().time_s);
        range.include(values->back().time_s);
    }
    return range;
}

std::string apart_caption(const records::Analysis& analysis)
{
    const auto& x = analysis.agreement.discrepancy_x;
    if (!x) return "The two sides were never running together.";
    const auto& bodies = analysis.agreement.bodies;
    return fmt::format("How far the two copies of {} are apart in x at equal times: {} mm on "
                       "average while both hands were on, {} mm at most.",
                       bodies.size() == 1 ? named_in_text(bodies.front().body)
                                          : "the body that is farthest apart",
                       shown(1e3 * x->mean, 2), shown(1e3 * x->max, 1));
}

/// "cube 0.12 mm, tool 3.4 mm": the mean of each.
std::string means_of(const std::vector<records::BodyAgreement>& bodies,
                     std::optional<metrics::Spread> records::BodyAgreement::*apart, double scale,
                     std::string_view unit)
{
    std::string text;
    for (const records::BodyAgreement& one : bodies) {
        if (!(one.*apart)) continue;
        text += fmt::format("{}{} {} {}", text.empty() ? "" : ", ", name_of(one.body),
                            shown(scale * (one.*apart)->mean, 2), unit);
    }
    return text.empty() ? "there was nothing to compare" : text;
}

std::vector<page::Curve> curves_of_bodies(const std::vector<records::BodyCurves>& bodies,
                                          Values records::BodyCurves::*values)
{
    std::vector<page::Curve> drawn;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if ((bodies[i].*values).empty()) continue;
        drawn.push_back(
            curve_of(bodies[i].name, body_colours[i % body_colours.size()], bodies[i].*values));
    }
    return drawn;
}

std::vector<page::Figure> figures_of(const results::RecordedSession& session,
                                     const std::string& prefix)
{
    std::vector<page::Figure> figures;
    const auto add = [&](std::string_view id, std::string title, page::Axis y,
                         std::vector<page::Curve> drawn, std::string caption) {
        if (drawn.empty()) return;
        figures.push_back(
            {.id = page::plain_id(fmt::format("{}-{}", prefix, id)),
             .title = std::move(title),
             .x = {.label = "time from the start", .unit = "s", .range = span_of(session.curves)},
             .y = std::move(y),
             .content = page::Curves{std::move(drawn)},
             .size = plot_size,
             .caption = std::move(caption)});
    };
    const records::SessionCurves& curves = session.curves;
    const auto& bodies = session.analysis.agreement.bodies;
    const std::string body = bodies.empty() ? "the body" : named_in_text(bodies.front().body);
    add("apart", "Distance of the two copies of " + body, {"|x_A − x_B|", "mm"},
        {curve_of("|x_A − x_B|", "ink", curves.apart_mm)}, apart_caption(session.analysis));
    add("cubes", fmt::format("Where each side has {}", body), {"x", "mm"},
        {curve_of("at A", "left", curves.cube_a_mm), curve_of("at B", "right", curves.cube_b_mm)},
        fmt::format("x of both copies of {}.", body));
    add("forces", "Force on each hand", {"force", "N"},
        {curve_of("on hand A", "left", curves.force_a_n),
         curve_of("on hand B", "right", curves.force_b_n)},
        "Magnitude of the force that each device was told to apply, after its governor.");
    // Where |x_A - x_B| does not say it all.
    add("bodies", "Distance of the two copies of each body", {"distance", "mm"},
        curves_of_bodies(curves.bodies, &records::BodyCurves::apart_mm),
        fmt::format("Distance in space at equal times; on average while both hands were on: {}.",
                    means_of(bodies, &records::BodyAgreement::discrepancy, 1e3, "mm")));
    add("angles", "Angle between the two copies of each body", {"angle", "deg"},
        curves_of_bodies(curves.bodies, &records::BodyCurves::turned_apart_deg),
        fmt::format("Angle of the rotation from one copy's orientation to the other's; on average "
                    "while both hands were on: {}.",
                    means_of(bodies, &records::BodyAgreement::turned_apart,
                             180.0 / std::numbers::pi, "deg")));
    return figures;
}

} // namespace

FigureGroups session_figures(const results::Results& results)
{
    FigureGroups groups;
    for (const results::RecordedSession& session : results.sessions) {
        const bool is_one_of_many =
            std::ranges::count(results.sessions, session.name, &results::RecordedSession::name) > 1;
        const auto prefix = is_one_of_many ? fmt::format("session-{}-{}-{}", session.name,
                                                         session.peer_a, session.peer_b)
                                           : "session-" + session.name;
        const auto title = session.task.empty() ? session.name : "Task " + session.task;
        groups.push_back({title, figures_of(session, prefix)});
    }
    return groups;
}

} // namespace hapnet::lab::report
