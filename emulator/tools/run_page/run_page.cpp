// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/run_page/run_page.hpp"

#include "emulator/core/direction_report.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/core/regime_chain.hpp"
#include "emulator/tools/run_page/figures.hpp"
#include "proto/output/told.hpp"
#include "proto/page/page.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::emulator::tools {

namespace {

using page::Json;
using Rows = std::vector<std::vector<std::string>>; // texts of the cells

/// Returns a value as text; "–" for a missing value.
std::string text_of(const nlohmann::ordered_json& value)
{
    if (value.is_null()) return "–";
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_number_float()) return value.dump();
    const double number = value.get<double>();
    constexpr double four_digits = 1e4; // from here on: whole numbers, no exponent
    return std::abs(number) < four_digits ? fmt::format("{:.4g}", number)
                                          : fmt::format("{:.0f}", number);
}

/// Returns a value of the statistics as text.
std::string shown(const nlohmann::ordered_json& statistics, const char* pointer)
{
    const nlohmann::ordered_json::json_pointer at{pointer};
    return text_of(statistics.contains(at) ? statistics[at] : nlohmann::ordered_json{});
}

/// Returns a table. `has_words`: the last column has sentences, which wrap.
Json table(std::string caption, const std::vector<std::string>& heads, const Rows& rows,
           bool has_words)
{
    page::Table table{std::move(caption), {heads.begin(), heads.end()}};
    for (const auto& row : rows) {
        auto& cells = table.rows.emplace_back();
        for (const auto& words : row)
            cells.push_back({words, cells.size() + 1 == heads.size() && has_words ? "words" : ""});
    }
    return json_of(table);
}

/// Returns the banner: it says if the run kept its budget, met its checks and followed its laws.
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
    if (run.verification && !has_failed) text += " All tests of its laws passed.";
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
    return table("Counters and times of both directions",
                 {"", std::string{words_on(Direction::up)}, std::string{words_on(Direction::down)}},
                 rows, false);
}

/// Returns a table with a row for each flow and direction. The other paths of a run are on pages of
/// their own.
Json flows_table(const nlohmann::ordered_json& statistics)
{
    Rows rows;
    const auto flows = statistics.value("flows", nlohmann::ordered_json::object());
    for (const auto& [name, flow] : flows.items()) {
        for (const char* way : {"up", "down"}) {
            const auto of = flow.value(way, nlohmann::ordered_json::object());
            rows.push_back({fmt::format("{} {}", name, way), shown(of, "/received"),
                            shown(of, "/delivered"), shown(of, "/lens/delay_ms/p50"),
                            shown(of, "/lens/delay_ms/p99")});
        }
    }
    if (rows.empty()) return nullptr;
    return table("Flows: report --flow NAME draws one of them",
                 {"flow", "received", "delivered", "delay p50 (ms)", "delay p99 (ms)"}, rows,
                 false);
}

/// Returns a table with a row for each regime and direction.
Json regimes_table(const nlohmann::ordered_json& statistics, const Path& path)
{
    Rows rows;
    for (const Direction direction : {Direction::up, Direction::down}) {
        const std::string way{to_text(direction)};
        const Conditions& conditions = direction == Direction::up ? path.up : path.down;
        const auto of = statistics.value(way, nlohmann::ordered_json::object())
                            .value("regimes", nlohmann::ordered_json::object());
        for (std::size_t i = 0; i < conditions.regimes.all.size(); ++i) {
            const auto& all = conditions.regimes.all.get();
            const auto told = of.value(all[i].name, nlohmann::ordered_json::object());
            rows.push_back({fmt::format("{} {}", way, all[i].name),
                            fmt::format("{:.4g}", shares_of(all)[i]), shown(told, "/share"),
                            shown(told, "/stays")});
        }
    }
    if (rows.empty()) return nullptr;
    return table("Regimes",
                 {"regime", "share of the time\nin the long run", "in this run", "stays"}, rows,
                 false);
}

/// Returns the word that verify prints.
std::string_view in_words(Outcome outcome)
{
    return outcome == Outcome::unable ? "cannot tell" : base::name_of(outcome);
}

std::string settings_of(const nlohmann::ordered_json& change)
{
    std::string text;
    const auto settings = change.value("settings", nlohmann::ordered_json::object());
    for (const auto& [key, value] : settings.items()) {
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", key,
                            value.is_string() ? value.get<std::string>() : value.dump());
    }
    return text;
}

/// Returns a table with a row for each change. A ramp is one row, from its first step to its last.
Json changes_table(const nlohmann::ordered_json& statistics)
{
    Rows rows;
    const auto changes = statistics.value("changes", nlohmann::ordered_json::array());
    for (std::size_t i = 0; i < changes.size(); ++i) {
        if (i + 1 < changes.size() && ends_ramp(changes[i], changes[i + 1])) continue;
        const bool is_ramp = i > 0 && ends_ramp(changes[i - 1], changes[i]);
        const auto& first = is_ramp ? changes[i - 1] : changes[i];
        const std::string at = shown(changes[i], "/elapsed_s");
        rows.push_back({is_ramp ? fmt::format("{} to {}", shown(first, "/elapsed_s"), at) : at,
                        shown(changes[i], "/by"),
                        fmt::format("{} / {}", shown(first, "/effective_at/up"),
                                    shown(first, "/effective_at/down")),
                        settings_of(changes[i])});
    }
    if (rows.empty()) return nullptr;
    return table(
        "Changes of the conditions",
        {"at, s since the\nemulator started", "by", "from datagram\nup / down", "settings"}, rows,
        true);
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
            rows.push_back(
                {fmt::format("{}: {}", where, result.name), std::string{in_words(result.outcome)},
                 result.p_value ? fmt::format("{:.3g}", *result.p_value) : "", result.sentence});
        }
    };
    add("up", run.verification->up);
    add("down", run.verification->down);
    add("between", run.verification->between);
    section.add(page::paragraph("A test fails when a run that follows its profile would look like "
                                "this one time in a million. A test cannot tell where the run has "
                                "too few datagrams for it."));
    section.add(
        table("Tests of the fates", {"test", "outcome", "p", "expected and observed"}, rows, true));
}

/// Figures side by side in panels, and figures over the whole width.
struct Placed {
    Json panels = Json::array();
    Json strips = Json::array();
};

/// True if the conditions of the start have changed.
bool has_changed(const RunRecord& run)
{
    return !run.profile.timeline.empty() || run.statistics.value("generation", 1) != 1;
}

/// Returns true if the path has regimes, so that no single law describes its delays.
bool has_regimes(const RunRecord& run)
{
    const Path path = profile_of(run.profile, run.link).path;
    return !path.up.regimes.empty() || !path.down.regimes.empty();
}

void add_direction(page::Section& section, Placed& placed, const RunRecord& run,
                   Direction direction)
{
    const auto& statistics = run.statistics;
    const Path path = profile_of(run.profile, run.link).path;
    const bool is_up = direction == Direction::up;
    const auto of = statistics.value(is_up ? "up" : "down", Json::object());
    std::span<const Fate> fates;
    if (run.fates) fates = is_up ? run.fates->up : run.fates->down;
    const double received = of.value("received", 0.0);
    const double length_s = statistics.value("duration_s", 0.0);
    const RunDirection one{.direction = direction,
                           .statistics = of,
                           .conditions = has_changed(run) || has_regimes(run) ? nullptr
                                         : is_up                              ? &path.up
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
    if (!run.fates_file.empty()) section.sources = {run.fates_file};
    Placed placed;
    for (const Direction direction : {Direction::up, Direction::down})
        add_direction(section, placed, run, direction);
    if (placed.panels.empty() && placed.strips.empty()) {
        section.add(page::paragraph("There are no distributions in these statistics: run with "
                                    "--fates, too."));
    }
    for (Json& strip : placed.strips) section.add(std::move(strip));
    if (!placed.panels.empty()) section.add(page::panels("", std::move(placed.panels)));
    section.add(figures_table(run.statistics));
    Json regimes = regimes_table(run.statistics, profile_of(run.profile, run.link).path);
    if (!regimes.is_null()) section.add(std::move(regimes));
    if (Json table = flows_table(run.statistics); !table.is_null()) section.add(std::move(table));
    section.add(page::paragraph(fmt::format(
        "Quantiles come from a histogram: they are within 1.6 %, and within the least and "
        "the most.{}",
        has_changed(run) ? " All conditions of the run are in them together: a step of "
                           "the delay adds to sd and quantiles, and is no jitter."
                         : "")));
    return section;
}

/// Returns the section with the conditions and the measurements on one time axis.
page::Section course_of(const RunRecord& run)
{
    page::Section section{"course", "What happened over time"};
    if (!run.statistics_file.empty()) section.sources = {run.statistics_file};
    auto [figures, why_not_asked] =
        course_figures(profile_of(run.profile, run.link).path, run.statistics);
    Json drawn = Json::array();
    for (page::Figure& figure : figures) drawn.push_back(section.keep(std::move(figure)));
    if (!why_not_asked.empty()) {
        section.add(page::paragraph(
            fmt::format("The conditions over time are not drawn: {}.", why_not_asked)));
    }
    if (!drawn.empty()) {
        section.add(page::panels("", std::move(drawn)));
        section.add(page::paragraph("All times count from the start of the emulator, in seconds."));
    }
    if (Json table = changes_table(run.statistics); !table.is_null()) section.add(std::move(table));
    return section;
}

constexpr std::size_t asked_length_max = 200; // characters; longer texts are not read at a glance

/// Returns the conditions of the start in one sentence: " Asked, both ways: delay 30ms, loss 2%."
/// Empty if they are too many for one sentence.
std::string asked_of(const RunRecord& run)
{
    Profile start;
    start.path = profile_of(run.profile, run.link).path;
    std::string words;
    for (const char c : to_text(start))
        words += c == '\n' ? std::string_view{"; "} : std::string_view{&c, 1};
    while (words.ends_with(' ') || words.ends_with(';')) words.pop_back();
    words.erase(0, words.find_first_not_of("; "));
    for (const auto& [from, to] :
         std::vector<std::pair<std::string_view, std::string_view>>{{"; ; ", "; "},
                                                                    {"[both]; ", "both ways: "},
                                                                    {"[up]; ", "up: "},
                                                                    {"[down]; ", "down: "},
                                                                    {" = ", " "},
                                                                    {"\"", ""},
                                                                    {";", ","}}) {
        for (std::size_t at = 0; (at = words.find(from, at)) != std::string::npos; at += to.size())
            words.replace(at, from.size(), to);
    }
    if (words.empty()) words = "nothing";
    if (words.size() > asked_length_max) return "";
    return fmt::format(" Asked{}: {}.", run.profile.timeline.empty() ? "" : " at the start", words);
}

} // namespace

std::string run_page(const RunRecord& run)
{
    const auto& statistics = run.statistics;
    const std::string profile = run.profile.name.empty() ? "An emulated path" : run.profile.name;
    page::Page page{"emulator-run",
                    run.link.empty() ? profile : fmt::format("{}, {}", profile, run.link),
                    fmt::format("A run of hapnet-emulator: {} s, seed {}, timing {}.{}",
                                shown(statistics, "/duration_s"), shown(statistics, "/seed"),
                                shown(statistics, "/timing"), asked_of(run))};
    page.head.push_back(banner(run));
    if (auto course = course_of(run); !course.blocks.empty())
        page.sections.push_back(std::move(course));
    page.sections.push_back(figures_of(run));
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
