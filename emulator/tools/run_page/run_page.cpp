// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/run_page/run_page.hpp"

#include "emulator/core/direction_report.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/tools/run_page/figures.hpp"
#include "proto/output/told.hpp"
#include "proto/page/page.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <vector>

namespace hapnet::emulator::tools {

namespace {

using page::Json;
using Rows = std::vector<std::vector<std::string>>; // texts

/// "–" of what is not there.
std::string text_of(const nlohmann::ordered_json& value)
{
    if (value.is_null()) return "–";
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
    return value.dump();
}

/// A value of the statistics as text.
std::string shown(const nlohmann::ordered_json& statistics, const char* pointer)
{
    const nlohmann::ordered_json::json_pointer at{pointer};
    return text_of(statistics.contains(at) ? statistics[at] : nlohmann::ordered_json{});
}

Json table(std::string caption, const std::vector<std::string>& heads, const Rows& rows)
{
    page::Table table{std::move(caption), {heads.begin(), heads.end()}};
    for (const auto& row : rows) {
        auto& cells = table.rows.emplace_back();
        for (const auto& words : row) cells.push_back({words, cells.empty() ? "" : "words"});
    }
    return json_of(table);
}

/// Whether the run kept its budget, met its checks and followed its laws.
Json banner(const RunRecord& run)
{
    const auto& statistics = run.statistics;
    const bool is_valid = statistics.value("valid", false);
    std::vector<Json> against;
    for (const auto& reason :
         statistics.value("invalid_because", nlohmann::ordered_json::array())) {
        if (reason.is_string()) against.push_back(reason);
    }
    for (const auto& check : statistics.value("checks", nlohmann::ordered_json::array())) {
        if (check.value("met", true)) continue;
        against.push_back(fmt::format("not met: {}, it is {}", check.value("require", ""),
                                      shown(check, "/value")));
    }
    const bool has_failed = run.verification && run.verification->failed();
    if (has_failed) against.emplace_back("the fates do not follow the profile: see the tests");
    std::string text = is_valid ? "Valid: the emulator kept its own timing budget." : "Not valid.";
    if (run.verification && !has_failed) text += " No test speaks against its laws.";
    const bool is_met = against.empty() && is_valid;
    return page::banner(is_met ? "met" : "missed", page::bold(text), std::move(against));
}

Json figures_table(const nlohmann::ordered_json& statistics)
{
    const auto of = [&](const char* way) {
        return output::told_figures(base::field_table<DirectionReport>(),
                                    statistics.value(way, nlohmann::ordered_json::object()));
    };
    Rows rows;
    const auto add = [&](const std::vector<output::ToldFigure>& figures, std::size_t column) {
        for (const output::ToldFigure& figure : figures) {
            auto row =
                std::ranges::find(rows, figure.words, [](const auto& one) { return one[0]; });
            if (row == rows.end()) row = rows.insert(rows.end(), {figure.words, "–", "–"});
            (*row)[column] = text_of(figure.value);
        }
    };
    add(of("up"), 1);
    add(of("down"), 2);
    return table("Counters and times of both directions", {"", "up (A to B)", "down (B to A)"},
                 rows);
}

Json changes_table(const nlohmann::ordered_json& statistics)
{
    Rows rows;
    for (const auto& change : statistics.value("changes", nlohmann::ordered_json::array())) {
        std::string settings;
        const auto changed = change.value("settings", nlohmann::ordered_json::object());
        for (const auto& [key, value] : changed.items()) {
            settings += fmt::format("{}{} {}", settings.empty() ? "" : ", ", key,
                                    value.is_string() ? value.get<std::string>() : value.dump());
        }
        rows.push_back({shown(change, "/generation"), shown(change, "/elapsed_s"),
                        shown(change, "/by"), shown(change, "/effective_at/up"),
                        shown(change, "/effective_at/down"), settings});
    }
    if (rows.empty()) return nullptr;
    return table(
        "Changes of the conditions",
        {"generation", "at (s)", "by", "first datagram up", "first datagram down", "settings"},
        rows);
}

void add_tests(page::Section& section, const RunRecord& run)
{
    if (!run.verification) {
        section.add(page::paragraph(fmt::format("Not tested: {}", run.why_unverified)));
        return;
    }
    Rows rows;
    const auto add = [&](std::string_view where, const std::vector<TestResult>& results) {
        for (const TestResult& result : results) {
            rows.push_back({fmt::format("{}: {}", where, result.name),
                            std::string{base::name_of(result.outcome)},
                            result.p_value ? fmt::format("{:.3g}", *result.p_value) : "",
                            result.sentence});
        }
    };
    add("up", run.verification->up);
    add("down", run.verification->down);
    add("between", run.verification->between);
    section.add(page::paragraph("A test fails when a run that follows its profile would look like "
                                "this one time in a million. One that is unable has too little to "
                                "go by."));
    section.add(
        table("Tests of the fates", {"test", "outcome", "p", "expected and observed"}, rows));
}

/// Figures beside each other in panels, and over the whole width.
struct Placed {
    Json panels = Json::array();
    Json strips = Json::array();
};

void add_direction(page::Section& section, Placed& placed, const RunRecord& run,
                   Direction direction)
{
    const auto& statistics = run.statistics;
    const bool has_changed =
        !run.profile.timeline.empty() || statistics.value("generation", 1) != 1;
    const Path path = profile_of(run.profile, run.link).path;
    const bool is_up = direction == Direction::up;
    const auto of = statistics.value(is_up ? "up" : "down", Json::object());
    std::span<const Fate> fates;
    if (run.fates) fates = is_up ? run.fates->up : run.fates->down;
    const double received = of.value("received", 0.0);
    const double length_s = statistics.value("duration_s", 0.0);
    const RunDirection one{.direction = direction,
                           .statistics = of,
                           .conditions = has_changed ? nullptr
                                         : is_up     ? &path.up
                                                     : &path.down,
                           .fates = fates,
                           .spacing_s = received > 0.0 ? length_s / received : 0.0};
    const double budget_us = statistics.value("budget_us", 1000.0);
    for (auto figure : {delay_figure(one), lateness_figure(one, budget_us), loss_runs_figure(one)})
        if (figure) placed.panels.push_back(section.keep(*std::move(figure)));
    if (auto strip = loss_figure(one)) placed.strips.push_back(section.keep(*std::move(strip)));
}

page::Section figures_of(const RunRecord& run)
{
    page::Section section{"figures", "What came out"};
    section.add(figures_table(run.statistics));
    Placed placed;
    for (const Direction direction : {Direction::up, Direction::down})
        add_direction(section, placed, run, direction);
    if (placed.panels.empty() && placed.strips.empty()) {
        section.add(page::paragraph("There are no distributions in these statistics: run with "
                                    "--fates, too."));
    }
    for (Json& strip : placed.strips) section.add(std::move(strip));
    if (!placed.panels.empty()) section.add(page::panels("", std::move(placed.panels)));
    return section;
}

page::Section changes_of(const nlohmann::ordered_json& statistics)
{
    page::Section section{"changes", "What changed"};
    if (auto figure = changes_figure(statistics)) section.add(*std::move(figure));
    if (Json table = changes_table(statistics); !table.is_null()) section.add(std::move(table));
    return section;
}

} // namespace

std::string run_page(const RunRecord& run)
{
    const auto& statistics = run.statistics;
    const std::string profile = run.profile.name.empty() ? "An emulated path" : run.profile.name;
    page::Page page{"emulator-run",
                    run.link.empty() ? profile : fmt::format("{}, {}", profile, run.link),
                    fmt::format("A run of hapnet-emulator: {} s, seed {}, timing {}.",
                                shown(statistics, "/duration_s"), shown(statistics, "/seed"),
                                shown(statistics, "/timing"))};
    page.head.push_back(banner(run));
    page.sections.push_back(figures_of(run));
    if (auto changes = changes_of(statistics); !changes.blocks.empty())
        page.sections.push_back(std::move(changes));
    add_tests(page.sections.emplace_back(page::Section{"tests", "Did it follow its laws?"}), run);
    auto& again = page.sections.emplace_back(page::Section{"repeat", "How to repeat it"});
    again.add(
        page::paragraph(fmt::format("{} {} (commit {}). The profile of the start, with its seed:",
                                    shown(statistics, "/program"), shown(statistics, "/version"),
                                    shown(statistics, "/commit"))));
    again.add(page::preformatted(to_text(run.profile)));
    return html_of(page);
}

} // namespace hapnet::emulator::tools
