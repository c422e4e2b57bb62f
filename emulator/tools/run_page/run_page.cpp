// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/run_page/run_page.hpp"

#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/tools/run_page/figures.hpp"
#include "proto/plot/axis.hpp"
#include "proto/plot/page.hpp"

#include <array>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <vector>

namespace hapnet::emulator::tools {

namespace {

using plot::escaped;
using Rows = std::vector<std::vector<std::string>>; // texts

/// A value of the statistics as text; "–" where there is none.
std::string shown(const nlohmann::ordered_json& statistics, const char* pointer)
{
    const nlohmann::ordered_json::json_pointer at{pointer};
    if (!statistics.contains(at) || statistics[at].is_null()) return "–";
    const auto& value = statistics[at];
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
    return value.dump();
}

std::string table(const std::vector<std::string_view>& heads, const Rows& rows)
{
    std::string out = "<div class=\"scroll\"><table>\n<thead><tr>";
    for (const auto head : heads) out += fmt::format("<th scope=\"col\">{}</th>", escaped(head));
    out += "</tr></thead>\n<tbody>\n";
    for (const auto& row : rows) {
        out += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i) {
            out += i == 0 ? fmt::format("<th scope=\"row\">{}</th>", escaped(row[i]))
                          : fmt::format("<td class=\"words\">{}</td>", escaped(row[i]));
        }
        out += "</tr>\n";
    }
    return out + "</tbody>\n</table></div>\n";
}

std::string section(std::string_view title, const std::string& html)
{
    return html.empty() ? "" : fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", title, html);
}

std::string list_of(const std::vector<std::string>& lines)
{
    std::string out = "<ul>\n";
    for (const auto& line : lines) out += fmt::format("<li>{}</li>\n", escaped(line));
    return out + "</ul>\n";
}

/// Whether the run kept its budget, met its checks and followed its laws.
std::string banner(const RunRecord& run)
{
    const auto& statistics = run.statistics;
    const bool is_valid = statistics.value("valid", false);
    std::vector<std::string> against;
    for (const auto& reason :
         statistics.value("invalid_because", nlohmann::ordered_json::array())) {
        if (reason.is_string()) against.push_back(reason.get<std::string>());
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
    return fmt::format("<div class=\"banner {}\">\n<p><b>{}</b></p>\n{}</div>\n",
                       against.empty() && is_valid ? "met" : "missed", text,
                       against.empty() ? "" : list_of(against));
}

std::string figures_table(const nlohmann::ordered_json& statistics)
{
    struct Row {
        const char* name;
        const char* key;
    };
    constexpr std::array rows{Row{"received", "received"},
                              Row{"delivered", "delivered"},
                              Row{"duplicated", "duplicated"},
                              Row{"corrupted", "corrupted"},
                              Row{"reordered", "reordered"},
                              Row{"in flight at the end", "in_flight"},
                              Row{"delay as drawn, mean (ms)", "lens/requested_delay_ms/mean"},
                              Row{"delay as drawn, deviation (ms)", "lens/requested_delay_ms/sd"},
                              Row{"delay as it came out, mean (ms)", "lens/delay_ms/mean"},
                              Row{"delay as it came out, deviation (ms)", "lens/delay_ms/sd"},
                              Row{"delay as it came out, p99 (ms)", "lens/delay_ms/p99"},
                              Row{"lateness of the emulator, p50 (µs)", "lateness_us/p50"},
                              Row{"lateness of the emulator, p99 (µs)", "lateness_us/p99"},
                              Row{"lateness of the emulator, most (µs)", "lateness_us/max"},
                              Row{"from strangers", "strangers"},
                              Row{"overflowed", "overflowed"}};
    Rows out;
    for (const auto& [name, key] : rows) {
        out.push_back({name, shown(statistics, fmt::format("/up/{}", key).c_str()),
                       shown(statistics, fmt::format("/down/{}", key).c_str())});
    }
    for (const DropCause cause : drop_causes) {
        const auto of = [&](const char* way) {
            return shown(statistics, fmt::format("/{}/dropped/{}", way, to_text(cause)).c_str());
        };
        const auto up = of("up");
        const auto down = of("down");
        const auto is_nothing = [](const std::string& text) { return text == "0" || text == "–"; };
        if (is_nothing(up) && is_nothing(down)) continue;
        out.push_back({fmt::format("dropped: {}", to_text(cause)), up, down});
    }
    return table({"", "up (A to B)", "down (B to A)"}, out);
}

std::string changes_table(const nlohmann::ordered_json& statistics)
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
    if (rows.empty()) return "";
    return table(
        {"generation", "at (s)", "by", "first datagram up", "first datagram down", "settings"},
        rows);
}

std::string tests_of(const RunRecord& run)
{
    if (!run.verification) {
        return fmt::format("<p>Not tested: {}</p>\n", escaped(run.why_unverified));
    }
    Rows rows;
    const auto add = [&](std::string_view where, const std::vector<TestResult>& results) {
        for (const TestResult& result : results) {
            rows.push_back(
                {fmt::format("{}: {}", where, result.name), std::string{to_text(result.outcome)},
                 result.p_value ? fmt::format("{:.3g}", *result.p_value) : "", result.sentence});
        }
    };
    add("up", run.verification->up);
    add("down", run.verification->down);
    add("between", run.verification->between);
    return "<p>A test fails when a run that follows its profile would look like this one time in a "
           "million. One that is unable has too little to go by.</p>\n" +
           table({"test", "outcome", "p", "expected and observed"}, rows);
}

std::string figures_of(const RunRecord& run)
{
    const auto& statistics = run.statistics;
    const bool has_changed =
        !run.profile.timeline.empty() || statistics.value("generation", 1) != 1;
    const Path path = profile_of(run.profile, run.link).path;
    std::string panels;
    std::string strips;
    for (const Direction direction : {Direction::up, Direction::down}) {
        const bool is_up = direction == Direction::up;
        const auto of = statistics.value(is_up ? "up" : "down", nlohmann::ordered_json::object());
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
        panels += delay_figure(one) + lateness_figure(one, statistics.value("budget_us", 1000.0)) +
                  loss_runs_figure(one);
        strips += loss_figure(one);
    }
    if (panels.empty() && strips.empty()) {
        return "<p>There are no distributions in these statistics: run with --fates, too.</p>\n";
    }
    return strips + fmt::format("<div class=\"panels\">\n{}</div>\n", panels);
}

} // namespace

std::string run_page(const RunRecord& run)
{
    const auto& statistics = run.statistics;
    const std::string profile = run.profile.name.empty() ? "An emulated path" : run.profile.name;
    const std::string name = run.link.empty() ? profile : fmt::format("{}, {}", profile, run.link);
    std::string page = plot::page_head(name, "emulator-run");
    page += fmt::format("<h1>{}</h1>\n<p class=\"lead\">A run of hapnet-emulator: {} s, seed {}, "
                        "timing {}.</p>\n",
                        escaped(name), escaped(shown(statistics, "/duration_s")),
                        escaped(shown(statistics, "/seed")), escaped(shown(statistics, "/timing")));
    page += banner(run);
    page += section("What came out", figures_table(statistics) + figures_of(run));
    page += section("What changed", changes_figure(statistics) + changes_table(statistics));
    page += section("Did it follow its laws?", tests_of(run));
    page += section(
        "How to repeat it",
        fmt::format("<p>{} {} (commit {}). The profile of the start, with its seed:</p>\n"
                    "<pre>{}</pre>\n",
                    escaped(shown(statistics, "/program")), escaped(shown(statistics, "/version")),
                    escaped(shown(statistics, "/commit")), escaped(to_text(run.profile))));
    return page + plot::page_foot();
}

} // namespace hapnet::emulator::tools
