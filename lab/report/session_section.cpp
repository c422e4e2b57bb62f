// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/analysis_report.hpp"
#include "lab/records/bodies.hpp"
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"
#include "proto/plot/plot.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

using plot::escaped;

namespace {

constexpr std::size_t curve_points_max = 4000; // a curve: finer than pixels, and no peak is lost
constexpr plot::Size plot_size{900.0, 230.0};
constexpr std::string_view colour_a = "var(--left)";
constexpr std::string_view colour_b = "var(--right)";
/// Of the bodies of a session, in their order; there are eight at most.
constexpr std::array<std::string_view, 8> body_colours{
    "var(--left)",   "var(--right)", "var(--sep)",        "var(--other)",
    "var(--missed)", "var(--met)",   "var(--calibrated)", "var(--muted)"};

plot::Curve curve_of(std::string_view name, std::string_view colour,
                     const std::vector<records::TimedValue>& values)
{
    std::vector<plot::Point> points;
    for (const records::TimedValue& one : values) points.push_back({one.time_s, one.value});
    return {.name = name, .colour = colour, .points = plot::thinned(points, curve_points_max)};
}

/// The first and the last time of what is drawn: all plots of a session span the same.
plot::Range span_of(const records::SessionCurves& curves)
{
    plot::Range range;
    for (const auto* values : {&curves.cube_a_mm, &curves.cube_b_mm}) {
        if (values->empty()) continue;
        range.include(values->front().time_s);
        range.include(values->back().time_s);
    }
    return range;
}

std::string validity_of(const records::Analysis& analysis)
{
    std::string out = analysis.valid()
                          ? "<div class='banner met'><b>Valid.</b> Both loops kept their time, and "
                            "both sides were in session together."
                          : "<div class='banner missed'><b>Not valid.</b> These numbers do not "
                            "count:<ul>\n";
    for (const std::string& reason : analysis.invalid_because) {
        out += fmt::format("<li>{}</li>\n", escaped(reason));
    }
    return out + (analysis.valid() ? "</div>\n" : "</ul></div>\n");
}

/// Whose copies the discrepancy in x is of.
std::string farthest_or_only(const std::vector<records::BodyAgreement>& bodies)
{
    return bodies.size() == 1 ? escaped(named_in_text(bodies.front().body))
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

void add_plots(Section& section, const results::RecordedSession& session, const std::string& prefix)
{
    const records::SessionCurves& curves = session.curves;
    const plot::Range time = span_of(curves);
    const auto add = [&](std::string_view name, const plot::PlotTitles& titles,
                         std::span<const plot::Curve> drawn, const std::string& caption) {
        section.add_figure(fmt::format("session-{}-{}", prefix, name),
                           drawn_plot(titles, drawn, {.size = plot_size, .x = time}), caption);
    };
    const std::array apart{curve_of("|x_A − x_B|", "var(--ink)", curves.apart_mm)};
    const auto& bodies = session.analysis.agreement.bodies;
    const std::string body = bodies.empty() ? "the body" : named_in_text(bodies.front().body);
    const std::string apart_title = "Distance of the two copies of " + body;
    add("apart", {apart_title, "s from the start", "mm"}, apart, apart_caption(session.analysis));
    const std::array copies{curve_of("at A", colour_a, curves.cube_a_mm),
                            curve_of("at B", colour_b, curves.cube_b_mm)};
    const std::string place_title = fmt::format("Where each side has {}", body);
    add("cubes", {place_title, "s from the start", "x, mm"}, copies,
        fmt::format("x of both copies of {}.", escaped(body)));
    const std::array forces{curve_of("on hand A", colour_a, curves.force_a_n),
                            curve_of("on hand B", colour_b, curves.force_b_n)};
    add("forces", {"Force on each hand", "s from the start", "N"}, forces,
        "Magnitude of the force that each device was told to apply, after its governor.");
}

/// "cube 0.12 mm, tool 3.4 mm": the mean of each.
std::string means_of(const std::vector<records::BodyAgreement>& bodies,
                     std::optional<metrics::Spread> records::BodyAgreement::*apart, double scale,
                     std::string_view unit)
{
    std::string text;
    for (const records::BodyAgreement& one : bodies) {
        if (!(one.*apart)) continue;
        text += fmt::format("{}{} {} {}", text.empty() ? "" : ", ", escaped(name_of(one.body)),
                            shown(scale * (one.*apart)->mean, 2), unit);
    }
    return text.empty() ? "there was nothing to compare" : text;
}

/// Distance and angle of the copies of each body, where |x_A - x_B| does not say it all.
void add_body_plots(Section& section, const results::RecordedSession& session,
                    const std::string& prefix)
{
    const auto& bodies = session.curves.bodies;
    const auto& agreement = session.analysis.agreement.bodies;
    const auto add = [&](std::string_view name, const plot::PlotTitles& titles,
                         std::vector<records::TimedValue> records::BodyCurves::*values,
                         const std::string& caption) {
        std::vector<plot::Curve> drawn;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if ((bodies[i].*values).empty()) continue;
            drawn.push_back(
                curve_of(bodies[i].name, body_colours[i % body_colours.size()], bodies[i].*values));
        }
        if (drawn.empty()) return;
        section.add_figure(
            fmt::format("session-{}-{}", prefix, name),
            drawn_plot(titles, drawn, {.size = plot_size, .x = span_of(session.curves)}), caption);
    };
    add("bodies", {"Distance of the two copies of each body", "s from the start", "mm"},
        &records::BodyCurves::apart_mm,
        "Distance in space at equal times; on average while both hands were on: " +
            means_of(agreement, &records::BodyAgreement::discrepancy, 1e3, "mm") + ".");
    add("angles", {"Angle between the two copies of each body", "s from the start", "deg"},
        &records::BodyCurves::turned_apart_deg,
        "Angle of the rotation from one copy's orientation to the other's; on average while both "
        "hands were on: " +
            means_of(agreement, &records::BodyAgreement::turned_apart, 180.0 / std::numbers::pi,
                     "deg") +
            ".");
}

/// `prefix`: of the names of its figures.
void add_session(Section& section, const results::RecordedSession& session,
                 const std::string& prefix)
{
    const auto title = session.task.empty() ? session.name : "Task " + session.task;
    section.html += fmt::format("<h3>{}</h3>\n<p>A is peer {}, B is peer {}", escaped(title),
                                session.peer_a, session.peer_b);
    if (!session.algorithm.empty()) {
        section.html += fmt::format("; algorithm {}", escaped(session.algorithm));
    }
    section.html += ".</p>\n" + validity_of(session.analysis);
    section.html += "<div class='zoom-group'>\n<p class='zoom-help' hidden>Drag across a plot to "
                    "zoom; all follow. <span class='zoom-buttons'></span></p>\n";
    add_plots(section, session, prefix);
    add_body_plots(section, session, prefix);
    section.html += "</div>\n<div class='panels'>\n";
    for (const records::TextTable& table : tables_of(session.analysis))
        section.html += html_of(table);
    section.html += "</div>\n";
    if (const auto clock = clock_text(session.analysis.clock); !clock.empty()) {
        section.html += fmt::format("<p>{}.</p>\n", escaped(clock));
    }
}

} // namespace

std::optional<Section> session_section(const results::Results& results)
{
    if (results.sessions.empty()) return std::nullopt;
    Section section{"sessions", results.sessions.size() == 1 ? "The session" : "The sessions",
                    "<p>Times count from the start of the session on A’s clock. Each session ends "
                    "with hands off: then the two copies of each body should agree again.</p>\n"};
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
