// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/analysis_report.hpp"
#include "lab/records/bodies.hpp"
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

constexpr std::size_t curve_points_max = 4000; // a curve: finer than pixels, and no peak is lost
constexpr page::Size plot_size{900.0, 230.0};
constexpr std::string_view colour_a = "left";
constexpr std::string_view colour_b = "right";
/// Of the bodies of a session, in their order; there are eight at most.
constexpr std::array<std::string_view, 8> body_colours{"left",   "right", "sep",        "other",
                                                       "missed", "met",   "calibrated", "muted"};

page::Curve curve_of(std::string_view name, std::string_view colour,
                     const std::vector<records::TimedValue>& values)
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

Json validity_of(const records::Analysis& analysis)
{
    const auto& reasons = analysis.invalid_because;
    std::vector<Json> list{reasons.begin(), reasons.end()};
    if (analysis.valid()) {
        return page::banner("met",
                            page::text_of({page::bold("Valid."), " Both loops kept their time, and "
                                                                 "both sides were in session "
                                                                 "together."}),
                            std::move(list));
    }
    return page::banner("missed",
                        page::text_of({page::bold("Not valid."), " These numbers do not count:"}),
                        std::move(list));
}

/// Whose copies the discrepancy in x is of.
std::string farthest_or_only(const std::vector<records::BodyAgreement>& bodies)
{
    return bodies.size() == 1 ? named_in_text(bodies.front().body)
                              : "the body that is farthest apart";
}

std::string apart_caption(const records::Analysis& analysis)
{
    const auto& x = analysis.agreement.discrepancy_x;
    if (!x) return "The two sides were never running together.";
    return fmt::format("How far the two copies of {} are apart in x at equal times: {} mm on "
                       "average while both hands were on, {} mm at most.",
                       farthest_or_only(analysis.agreement.bodies), shown(1e3 * x->mean, 2),
                       shown(1e3 * x->max, 1));
}

page::Figure over_time(std::string id, std::string title, page::Axis y,
                       std::vector<page::Curve> curves, std::string caption)
{
    return {.id = page::plain_id(std::move(id)),
            .title = std::move(title),
            .x = {"time from the start", "s"},
            .y = std::move(y),
            .content = page::Curves{std::move(curves)},
            .size = plot_size,
            .caption = std::move(caption)};
}

std::vector<page::Figure> figures_of(const results::RecordedSession& session,
                                     const std::string& prefix)
{
    const records::SessionCurves& curves = session.curves;
    const auto& bodies = session.analysis.agreement.bodies;
    const std::string body = bodies.empty() ? "the body" : named_in_text(bodies.front().body);
    return {over_time(prefix + "-apart", "Distance of the two copies of " + body,
                      {"|x_A − x_B|", "mm"}, {curve_of("|x_A − x_B|", "ink", curves.apart_mm)},
                      apart_caption(session.analysis)),
            over_time(prefix + "-cubes", fmt::format("Where each side has {}", body), {"x", "mm"},
                      {curve_of("at A", colour_a, curves.cube_a_mm),
                       curve_of("at B", colour_b, curves.cube_b_mm)},
                      fmt::format("x of both copies of {}.", body)),
            over_time(prefix + "-forces", "Force on each hand", {"force", "N"},
                      {curve_of("on hand A", colour_a, curves.force_a_n),
                       curve_of("on hand B", colour_b, curves.force_b_n)},
                      "Magnitude of the force that each device was told to apply, after its "
                      "governor.")};
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

/// Distance and angle of the copies of each body, where |x_A - x_B| does not say it all.
std::vector<page::Figure> body_figures(const results::RecordedSession& session,
                                       const std::string& prefix)
{
    const auto& bodies = session.curves.bodies;
    const auto curves_of = [&](std::vector<records::TimedValue> records::BodyCurves::*values) {
        std::vector<page::Curve> drawn;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if ((bodies[i].*values).empty()) continue;
            drawn.push_back(
                curve_of(bodies[i].name, body_colours[i % body_colours.size()], bodies[i].*values));
        }
        return drawn;
    };
    const auto& agreement = session.analysis.agreement.bodies;
    std::vector<page::Figure> figures;
    if (auto apart = curves_of(&records::BodyCurves::apart_mm); !apart.empty()) {
        figures.push_back(over_time(
            prefix + "-bodies", "Distance of the two copies of each body", {"distance", "mm"},
            std::move(apart),
            "Distance in space at equal times; on average while both hands were on: " +
                means_of(agreement, &records::BodyAgreement::discrepancy, 1e3, "mm") + "."));
    }
    if (auto turned = curves_of(&records::BodyCurves::turned_apart_deg); !turned.empty()) {
        figures.push_back(over_time(
            prefix + "-angles", "Angle between the two copies of each body", {"angle", "deg"},
            std::move(turned),
            "Angle of the rotation from one copy's orientation to the other's; on average while "
            "both hands were on: " +
                means_of(agreement, &records::BodyAgreement::turned_apart, 180.0 / std::numbers::pi,
                         "deg") +
                "."));
    }
    return figures;
}

/// `prefix`: of the names of its figures.
void add_session(Section& section, const results::RecordedSession& session,
                 const std::string& prefix)
{
    const auto title = session.task.empty() ? session.name : "Task " + session.task;
    section.add(page::heading(title));
    section.add(page::paragraph(fmt::format(
        "A is peer {}, B is peer {}{}.", session.peer_a, session.peer_b,
        session.algorithm.empty() ? "" : fmt::format("; algorithm {}", session.algorithm))));
    section.add(validity_of(session.analysis));
    Json blocks = Json::array();
    const auto add = [&](std::vector<page::Figure> figures) {
        for (page::Figure& figure : figures) {
            figure.x.range = span_of(session.curves);
            blocks.push_back(section.keep(std::move(figure)));
        }
    };
    add(figures_of(session, "session-" + prefix));
    add(body_figures(session, "session-" + prefix));
    section.add(page::zoomed(std::move(blocks)));
    Section tables{"", ""};
    for (const records::TextTable& table : tables_of(session.analysis)) add_table(tables, table);
    section.add(page::panels("", std::move(tables.blocks)));
    if (const auto clock = clock_text(session.analysis.clock); !clock.empty())
        section.add(page::paragraph(clock + "."));
}

} // namespace

std::optional<Section> session_section(const results::Results& results)
{
    if (results.sessions.empty()) return std::nullopt;
    Section section{"sessions", results.sessions.size() == 1 ? "The session" : "The sessions"};
    section.add(page::paragraph("Times count from the start of the session on A’s clock. Each "
                                "session ends with hands off: then the two copies of each body "
                                "should agree again."));
    for (const results::RecordedSession& session : results.sessions) {
        const bool is_one_of_many =
            std::ranges::count(results.sessions, session.name, &results::RecordedSession::name) > 1;
        const auto prefix =
            is_one_of_many ? fmt::format("{}-{}-{}", session.name, session.peer_a, session.peer_b)
                           : session.name;
        add_session(section, session, prefix);
    }
    return section;
}

} // namespace hapnet::lab::report
