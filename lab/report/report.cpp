// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/report.hpp"

#include "lab/records/analysis_report.hpp"
#include "lab/report/assets.hpp"
#include "lab/report/figures.hpp"
#include "lab/report/replays.hpp"
#include "lab/results/table_text.hpp"
#include "lab/results/verdicts.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

namespace {

using page::Json;
using Results = results::Results;

bool never(const Results&) { return false; }

/// Whether anything stands against the paper.
bool has_verdicts(const Results& results)
{
    const auto has = [](std::string_view key) {
        return [key](const results::TableRow& row) { return !row.text(key).empty(); };
    };
    const auto limits = results.rows("limits");
    return std::ranges::any_of(results.rows("table1"), has("verdict")) ||
           std::ranges::any_of(limits, [&](const results::TableRow& row) {
               return row.text("task") == results::worst_task && has("status")(row);
           });
}

/// A section of a page. It is there where its table has rows.
struct SectionKind {
    std::string_view id;
    std::string_view title;
    std::string_view table{}; // empty: `is_there` says it
    FigureGroups (*figures)(const Results&) = nullptr;
    /// The command that makes what is missing, up to the folder; empty: it comes with others.
    std::string_view what{};
    std::string_view command{};
    std::string_view subfolder{};
    bool (*is_there)(const Results&) = never;
};

constexpr std::array section_kinds{
    SectionKind{.id = "demo",
                .title = "The demo beside the paper’s Table 1",
                .is_there = [](const Results& r) { return r.demo.has_value(); }},
    SectionKind{.id = "replay",
                .title = "Look at it",
                .what = "the replay",
                .command = "scripts/table1.sh --out",
                .subfolder = "table1",
                .is_there = [](const Results& r) { return !r.replays.empty(); }},
    SectionKind{.id = "sessions",
                .title = "The sessions",
                .figures = session_figures,
                .is_there = [](const Results& r) { return !r.sessions.empty(); }},
    SectionKind{"table1", "Table 1: how far the two copies are apart", "table1", table1_figures,
                "Table 1", "scripts/table1.sh --out", "table1"},
    SectionKind{"fig6a", "Fig. 6a: tolerated delay and jitter", "limits", fig6a_figures, "Fig. 6a",
                "scripts/fig6a.sh --out", "fig6a"},
    SectionKind{"fig6b", "Fig. 6b: tolerated loss", "limits", fig6b_figures, "Fig. 6b",
                "scripts/fig6b.sh --out", "fig6b"},
    SectionKind{"curves", "The curves behind the limits", "curves", curves_figures, "the curves",
                "scripts/fig6a.sh --out", "fig6a"},
    SectionKind{"trust", "How far a limit can be trusted", "limits_by_convention", trust_figures,
                "how far a limit can be trusted", "scripts/fig6a.sh --out", "fig6a"},
    SectionKind{"precision", "What accuracy costs", "precision", precision_figures},
    SectionKind{"axis", "What was not chosen, and what the paper leaves open", "limits_by_axis",
                axis_figures},
    SectionKind{"points", "Conditions varied together", "qos_by_point", points_figures},
    SectionKind{"paired", "Algorithms seed by seed", "paired"},
    SectionKind{"fig7", "Fig. 7: where each side has the cube", "trajectories", fig7_figures,
                "Fig. 7", "scripts/fig7.sh --out", "fig7"},
    SectionKind{"qos", "What a network must offer", "qos", qos_figures, "what a network must offer",
                "scripts/qos.sh --out", "qos"},
    SectionKind{"tasks", "The closed-loop tasks beside it", "tasks", tasks_figures,
                "the closed-loop tasks", "scripts/table1.sh --out", "table1"},
    SectionKind{"real-time", "Real time beside virtual time", "real_time", real_time_figures,
                "real time", "scripts/table1.sh --real-time --out", "table1"},
    SectionKind{.id = "claims",
                .title = "What stands against the paper, and how it came about",
                .is_there = has_verdicts},
    SectionKind{"beyond", "What is claimed beyond the paper", "claims", nullptr,
                "what is claimed beyond the paper", "scripts/beat.sh --out", "beat"},
    SectionKind{.id = "runs", .title = "How to repeat it", .is_there = [](const Results& r) {
                    return !r.runs.empty();
                }}};

/// The file whose rows a section's figures show; empty: a file of the page's own.
std::string_view source_of(const SectionKind& kind)
{
    if (kind.id == "points") return "";
    return kind.id == "tasks" ? "sessions" : kind.table;
}

/// What a page is about. A page about one thing does not replace one about another unnoticed.
std::string subject_of(const Results& results)
{
    if (results.demo) return "demo";
    return !results.sessions.empty() && results.runs.empty() ? "session" : "experiments";
}

std::string title_of(const Results& results)
{
    if (results.runs.size() == 1) {
        const auto title = results.runs.front().manifest.value("title", Json{});
        if (title.is_string()) return title.get<std::string>();
    }
    if (subject_of(results) != "session") return "Two people, one cube, a bad network";
    if (results.sessions.size() > 1) return "Recorded sessions";
    const std::string& task = results.sessions.front().task;
    return task.empty() ? "A recorded session" : "A recorded session of task " + task;
}

Json json_of(const std::vector<records::TextTable>& tables)
{
    Json list = Json::array();
    for (const records::TextTable& table : tables) {
        Json rows = Json::array();
        for (const records::TextTable::Row& row : table.rows)
            rows.push_back({{"name", row.name}, {"cells", row.cells}, {"note", row.note}});
        list.push_back({{"caption", table.caption},
                        {"unit", table.unit},
                        {"heads", table.heads},
                        {"rows", std::move(rows)},
                        {"remarks", table.remarks}});
    }
    return list;
}

Json sessions_of(const Results& results)
{
    Json list = Json::array();
    for (const results::RecordedSession& session : results.sessions) {
        list.push_back({{"peers", {session.peer_a, session.peer_b}},
                        {"algorithm", session.algorithm},
                        {"valid", session.analysis.valid()},
                        {"invalid_because", session.analysis.invalid_because},
                        {"tables", json_of(tables_of(session.analysis))},
                        {"clock", clock_text(session.analysis.clock)}});
    }
    return list;
}

Json runs_of(const Results& results)
{
    Json list = Json::array();
    for (const results::Run& run : results.runs)
        list.push_back({{"folder", run.folder}, {"manifest", run.manifest}});
    return list;
}

/// The tables that a page shows, and not only draws.
Json tables_of(const Results& results)
{
    constexpr std::array<std::string_view, 10> are_shown{
        "table1", "tasks",     "limits",           "limits_by_convention", "paired",
        "claims", "precision", "claims_quantiles", "claim_sessions",       "real_time"};
    std::vector<results::Table> tables;
    for (const std::string_view name : are_shown)
        if (!results.table(name).is_empty()) tables.push_back(results.table(name));
    return Json::parse(results::json_text(tables)).at("tables");
}

/// A page on its way: its data, and its figures' own files.
class PageData {
public:
    PageData(const Results& results, std::string_view folder) : results_{results}
    {
        Json sections = Json::array(), missing = Json::array();
        for (const SectionKind& kind : section_kinds) {
            if (auto section = section_of(kind); !section.is_null()) {
                sections.push_back(std::move(section));
            } else if (!kind.command.empty()) {
                missing.push_back(
                    {{"what", kind.what},
                     {"command", fmt::format("{} {}/{}", kind.command, folder, kind.subfolder)}});
            }
        }
        data_ = {{"subject", subject_of(results)},
                 {"title", title_of(results)},
                 {"sections", std::move(sections)},
                 {"missing", subject_of(results) == "experiments" ? missing : Json::array()},
                 {"runs", runs_of(results)},
                 {"tables", tables_of(results)},
                 {"sessions", sessions_of(results)}};
        if (results.demo) data_["demo"] = json_of(demo_tables(*results.demo));
        data_["figures"] = std::move(figures_);
        if (!results.replays.empty()) data_["replays"] = replays_of(results);
    }

    std::vector<results::File> files() &&
    {
        std::vector<page::Asset> assets;
        for (const page::Asset& asset : lab_assets()) {
            const bool is_layout =
                std::ranges::find(layout_modules, asset.name) != layout_modules.end();
            if (is_layout || data_.contains("replays")) assets.push_back(asset);
        }
        files_.insert(files_.begin(), {"report.html", page::html_of(data_, assets)});
        return std::move(files_);
    }

private:
    /// null: it has no data.
    Json section_of(const SectionKind& kind)
    {
        if (kind.table.empty() ? !kind.is_there(results_) : results_.table(kind.table).is_empty())
            return nullptr;
        const auto groups = kind.figures == nullptr ? FigureGroups{} : kind.figures(results_);
        if (kind.figures != nullptr && groups.empty()) return nullptr;
        Json list = Json::array();
        for (const FigureGroup& group : groups) {
            Json names = Json::array();
            for (const page::Figure& figure : group.figures) {
                names.push_back(figure.id);
                add(figure, results_.files_of(source_of(kind)));
            }
            list.push_back({{"title", group.title}, {"figures", std::move(names)}});
        }
        const bool is_one = kind.id == "sessions" && results_.sessions.size() == 1;
        return {{"id", kind.id}, {"title", is_one ? "The session" : kind.title}, {"groups", list}};
    }

    /// A figure whose numbers no result file has gets a file of its own.
    void add(page::Figure figure, std::vector<std::string> sources)
    {
        if (figure.sources.empty()) figure.sources = std::move(sources);
        if (figure.sources.empty() && !std::holds_alternative<page::HeatMap>(figure.content)) {
            figure.sources = {fmt::format("figures/{}.csv", figure.id)};
            files_.push_back({figure.sources.front(), page::csv_of(page::json_of(figure))});
        }
        figures_.push_back(page::json_of(figure));
    }

    const Results& results_;
    Json figures_ = Json::array();
    Json data_;
    std::vector<results::File> files_;
};

} // namespace

std::string_view page_subject(std::string_view page)
{
    constexpr std::string_view key = "<meta name=\"hapnet-subject\" content=\"";
    const auto found = page.find(key);
    if (found == std::string_view::npos) return "";
    page.remove_prefix(found + key.size());
    return page.substr(0, page.find('"'));
}

std::vector<results::File> report_of(const results::Results& results, std::string_view folder)
{
    return PageData{results, folder}.files();
}

} // namespace hapnet::lab::report
