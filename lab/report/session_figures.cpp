// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/bodies.hpp"
#include "lab/report/figures.hpp"
#include "lab/report/path_figures.hpp"
#include "lab/report/patterns.hpp"
#include "lab/report/session_words.hpp"
#include "proto/page/distribution.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <numbers>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

using Values = std::vector<records::TimedValue>;

constexpr std::size_t curve_points_max = 4000; // per curve: finer than pixels, and no peak is lost
/// The colours of a session's bodies, in their order. There are at most eight.
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

/// Returns the curves of a quantity of both sides. Where they are equal, B's dashes lie on A's
/// line.
std::vector<page::Curve> of_both(std::string_view of, const Values& a, const Values& b)
{
    std::vector<page::Curve> both{curve_of(fmt::format("{} A", of), "left", a),
                                  curve_of(fmt::format("{} B", of), "right", b)};
    both.back().is_dashed = true;
    return both;
}

/// Returns the first and the last time of the drawn values. All plots of a session have the same
/// range.
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

/// Returns "cube 0.12 mm, tool 3.4 mm": the mean of each body.
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

std::vector<page::Figure> figures_of_bodies(const results::RecordedSession& session)
{
    std::vector<page::Figure> figures;
    const auto add = [&](std::string_view id, std::string title, page::Axis y,
                         std::vector<page::Curve> drawn, std::string caption) {
        if (drawn.empty()) return;
        figures.push_back({.id = std::string{id},
                           .title = std::move(title),
                           .x = {.label = "time from the start", .unit = "s"},
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
        of_both("at", curves.cube_a_mm, curves.cube_b_mm),
        fmt::format("x of both copies of {}.", body));
    add("forces", "Force on each hand", {"force", "N"},
        of_both("on hand", curves.force_a_n, curves.force_b_n),
        "Magnitude of the force that each device was told to apply, after its governor.");
    // These figures are for sessions that |x_A - x_B| alone does not describe.
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

/// Returns figures of the lateness of both loops' ticks. There are none in virtual time, where no
/// tick is late.
std::vector<page::Figure> lateness_figures(const records::SessionCurves& curves)
{
    std::vector<page::Curve> drawn;
    const auto add = [&](std::string_view name, std::string_view colour, bool is_dashed,
                         const std::vector<double>& late_us) {
        const bool is_late = std::ranges::any_of(late_us, [](double us) { return us > 0.0; });
        if (!is_late) return;
        drawn.push_back({.name = std::string{name},
                         .colour = colour,
                         .points = page::shares_at_most(late_us, share_points_max),
                         .width = 2.0,
                         .is_dashed = is_dashed});
    };
    add("A", "left", false, curves.late_a_us);
    add("B", "right", true, curves.late_b_us);
    if (drawn.empty()) return {};
    page::Figure figure = page::lateness_figure("lateness", "ticks", std::move(drawn),
                                                1e6 * base::to_seconds(records::tick_lateness_max));
    figure.title = "Lateness of the ticks";
    figure.caption = "How long after it was due each tick of a haptic loop began. The session is "
                     "valid only if both curves have reached 99 % at the budget.";
    return {std::move(figure)};
}

/// Returns all figures of a session: those over time, with the same range, and those of shares.
std::vector<page::Figure> figures_of(const results::RecordedSession& session,
                                     const std::string& prefix)
{
    const records::SessionCurves& curves = session.curves;
    std::vector<page::Figure> figures = figures_of_bodies(session);
    const std::string_view arrival = is_virtual(session) ? "its arrival, both in virtual time"
                                                         : "the stamp of the receiver’s kernel";
    std::ranges::move(path_figures(curves.paths, arrival), std::back_inserter(figures));
    for (page::Figure& figure : figures) figure.x.range = span_of(curves);
    std::ranges::move(delay_distribution(curves.paths), std::back_inserter(figures));
    std::ranges::move(lateness_figures(curves), std::back_inserter(figures));
    for (page::Figure& figure : figures)
        figure.id = page::plain_id(fmt::format("{}-{}", prefix, figure.id));
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
                                                         session.a.id, session.b.id)
                                           : "session-" + session.name;
        std::string title = session.task.empty() ? session.name : "Task " + session.task;
        if (is_one_of_many)
            title += fmt::format(": peers {} (A) and {} (B)", session.a.id, session.b.id);
        FigureGroup& group =
            groups.emplace_back(FigureGroup{std::move(title), figures_of(session, prefix), {}});
        for (const results::RecordedPeer* peer : {&session.a, &session.b})
            if (!peer->file.empty()) group.origins.push_back(peer->file);
    }
    return groups;
}

} // namespace hapnet::lab::report
