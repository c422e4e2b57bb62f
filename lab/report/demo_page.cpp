// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/demo_page.hpp"

#include "lab/report/page.hpp"

#include <array>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab {

namespace {

constexpr std::size_t every = 10; // ticks: 10 ms are finer than a pixel
constexpr std::string_view colour_a = "var(--left)";
constexpr std::string_view colour_b = "var(--right)";

bool is_in_session(const record::TickRow& row)
{
    return row.phase == record::Phase::running || row.phase == record::Phase::hands_off ||
           row.phase == record::Phase::alone;
}

std::string plots_of(std::string_view what, const TaskTrace& trace)
{
    const std::string cube_title = fmt::format("{}: where each peer has the cube", what);
    const std::string force_title = fmt::format("{}: the force on each hand", what);
    const std::array cubes{
        plot::Curve{.name = "peer 1", .colour = colour_a, .points = trace.cube_a_mm},
        plot::Curve{.name = "peer 2", .colour = colour_b, .points = trace.cube_b_mm}};
    const std::array forces{
        plot::Curve{.name = "peer 1", .colour = colour_a, .points = trace.force_a_n},
        plot::Curve{.name = "peer 2", .colour = colour_b, .points = trace.force_b_n}};
    return plot::svg_plot({cube_title, "s from the start", "x, mm"}, cubes) +
           plot::svg_plot({force_title, "s from the start", "N"}, forces);
}

} // namespace

TaskTrace task_trace_of(const Session& session)
{
    TaskTrace trace;
    const auto add = [&](const record::TickRow& row, base::TimePoint at, auto& cube, auto& force) {
        const double seconds = base::to_seconds(at - session.a.terms.start);
        cube.push_back({seconds, row.cube.x() * 1e3});
        force.push_back({seconds, norm(row.device)});
    };
    for (std::size_t i = 0; i < session.a.ticks.size(); i += every) {
        const record::TickRow& row = session.a.ticks[i];
        if (is_in_session(row)) add(row, row.at(), trace.cube_a_mm, trace.force_a_n);
    }
    for (std::size_t i = 0; i < session.b.ticks.size(); i += every) {
        const record::TickRow& row = session.b.ticks[i];
        const base::TimePoint at = session.clock.to_a(row.at());
        if (is_in_session(row)) add(row, at, trace.cube_b_mm, trace.force_b_n);
    }
    return trace;
}

std::string demo_page(const DemoRun& run, const DemoCircumstances& circumstances,
                      const TaskTrace& p1, const TaskTrace& t3)
{
    std::string page = report::page_head("Two peers, one cube, 160 ms");
    page += fmt::format("<h1>Two peers, one cube, 160 ms</h1>\n<p>{}</p>\n<pre>{}</pre>\n",
                        plot::escaped(circumstances.start), plot::escaped(demo_table(run)));
    page += "<p>While the left hand moves the cube, the right copy is where the left one was "
            "160 ms ago. In the last 3 s both hands are off, and the copies agree again.</p>\n";
    page += plots_of("P1, the left hand carries the cube", p1);
    page += plots_of("T3, both hands squeeze and carry it", t3);
    page += fmt::format("<h2>How to repeat it</h2>\n<pre>{}</pre>\n",
                        plot::escaped(demo_manifest(run, circumstances).dump(2)));
    return page + report::page_foot();
}

} // namespace hapnet::lab
