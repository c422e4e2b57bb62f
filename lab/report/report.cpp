// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/report.hpp"

#include "lab/metrics/psychometric.hpp"
#include "lab/records/analysis_report.hpp"
#include "lab/report/assets.hpp"
#include "lab/report/figures.hpp"
#include "lab/report/patterns.hpp"
#include "lab/report/played.hpp"
#include "lab/report/replays.hpp"
#include "lab/report/session_words.hpp"
#include "lab/results/table_text.hpp"
#include "lab/results/verdicts.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

namespace {

using page::Json;
using Results = results::Results;

bool never(const Results&) { return false; }

/// True if the results are recorded sessions alone, without an experiment.
bool is_of_sessions(const Results& results)
{
    return !results.sessions.empty() && results.runs.empty() && !results.demo;
}

/// True if any result is compared with the paper.
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

bool has_axis(const Results& results)
{
    return !results.table("limits_by_axis").is_empty() ||
           !results.table("table1_by_axis").is_empty();
}

/// Returns a title such as "How much delay and jitter is borne" for the searched impairments.
template <typename... Impairments>
std::string limits_title(const Results& results, Impairments... impairments)
{
    std::string searched;
    for (const std::string_view one : {impairments...}) {
        if (where(results.rows("limits"), "impairment", one).empty()) continue;
        searched += (searched.empty() ? "" : " and ") + people_say(one);
    }
    return fmt::format("How much {} is borne", searched);
}

/// Returns a title such as "Results by delay of the path".
std::string axis_title(const Results& results)
{
    for (const char* name : {"limits_by_axis", "table1_by_axis"}) {
        const auto parameters = distinct(results.rows(name), "parameter");
        if (!parameters.empty()) return "Results by " + people_say(parameters.front());
    }
    return "";
}

std::string table1_title(const Results& results)
{
    const bool has_paper =
        std::ranges::any_of(results.rows("table1"), [](const results::TableRow& row) {
            return row.number("paper_mean_mm").has_value();
        });
    return std::string{"How far the two copies are apart"} +
           (has_paper ? ", beside the paper’s Table 1" : "");
}

/// A section of a page. The page has it if its table has rows.
struct SectionKind {
    std::string_view id;
    std::string_view title{}; // empty: see `title_of`
    std::string_view table{}; // empty: see `is_there`
    FigureGroups (*figures)(const Results&) = nullptr;
    std::string (*title_of)(const Results&) = nullptr;
    bool (*is_there)(const Results&) = never;
};

constexpr std::array section_kinds{
    SectionKind{.id = "demo",
                .title = "The demo beside the paper’s Table 1",
                .is_there = [](const Results& r) { return r.demo.has_value(); }},
    SectionKind{.id = "sessions",
                .figures = session_figures,
                .title_of = [](const Results& r) -> std::string {
                    return r.sessions.size() == 1 ? "The session" : "The sessions";
                },
                .is_there = [](const Results& r) { return !r.sessions.empty(); }},
    SectionKind{"beyond", "Claims and results", "claims", claims_figures},
    SectionKind{
        .id = "axis", .title = "What came out", .figures = axis_figures, .is_there = has_axis},
    SectionKind{"table1", "", "table1", table1_figures, table1_title},
    SectionKind{"requirements", "What a network must offer", "requirements", requirements_figures},
    SectionKind{"fig6a", "", "limits", fig6a_figures,
                [](const Results& r) { return limits_title(r, "delay", "jitter"); }},
    SectionKind{"fig6b", "", "limits", fig6b_figures,
                [](const Results& r) { return limits_title(r, "random-loss", "burst-loss"); }},
    SectionKind{"qos", "Which networks each algorithm bears", "qos", qos_figures},
    SectionKind{"points", "Conditions varied together", "qos_by_point", points_figures},
    SectionKind{"precision", "What accuracy costs", "precision", precision_figures},
    SectionKind{"fig7", "Where each side has the cube, over time", "trajectories", fig7_figures},
    SectionKind{"rankings", "Whether recorded people rank the algorithms alike", "rankings"},
    SectionKind{"tasks", "Tasks in which both hands act on what they feel", "tasks", tasks_figures},
    SectionKind{.id = "replay",
                .title = "Look at it",
                .is_there = [](const Results& r) { return !r.replays.empty(); }},
    SectionKind{"curves", "The sessions behind the limits", "curves", curves_figures},
    SectionKind{"trust", "How far a limit can be trusted", "limits_by_convention", trust_figures},
    SectionKind{"paired", "Algorithms seed by seed", "paired"},
    SectionKind{"real-time", "Real time beside virtual time", "real_time", real_time_figures},
    SectionKind{.id = "claims",
                .title = "What stands against the paper, and how it came about",
                .is_there = has_verdicts},
    SectionKind{.id = "repeat", .title = "How to repeat it", .is_there = is_of_sessions},
    SectionKind{.id = "runs", .title = "How to repeat it", .is_there = [](const Results& r) {
                    return !r.runs.empty();
                }}};

/// Returns the file with the rows of a section's figures; empty: a file of the page's own.
std::string_view source_of(const SectionKind& kind)
{
    if (kind.id == "points") return "";
    if (kind.id == "requirements") return "limits";
    if (kind.id == "beyond") return "claims_numbers";
    return kind.id == "tasks" ? "sessions" : kind.table;
}

/// Returns the subject of a page. A page about one subject does not silently replace one about
/// another subject.
std::string subject_of(const Results& results)
{
    if (results.demo) return "demo";
    return is_of_sessions(results) ? "session" : "experiments";
}

std::string title_of(const Results& results)
{
    if (results.runs.size() == 1) {
        auto title = own_title_of(results.runs.front());
        if (!title.empty()) return title;
        if (has_axis(results)) return axis_title(results);
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

/// Returns the limits of the criteria that always judge.
Json json_of(const metrics::Criteria& criteria)
{
    const auto& [order, usable, good] = criteria;
    return {{"usable",
             {{"vibration_max_mm", 1e3 * at_order(usable.vibration_max_m, order)},
              {"discrepancy_max_mm", 1e3 * usable.discrepancy_max_m},
              {"slow_stiffness_error_max", usable.slow_stiffness_error_max},
              {"force_vibration_max_n", usable.force_vibration_max_n},
              {"scored_share_min", usable.scored_share_min}}},
            {"good",
             {{"discrepancy_max_mm", 1e3 * good.discrepancy_max_m},
              {"stiffness_error_max", good.stiffness_error_max},
              {"force_discrepancy_max", good.force_discrepancy_max},
              {"contact_lost_max", good.contact_lost_max},
              {"drag_max_n", good.drag_max_n}}}};
}

Json json_of(const std::vector<Repeat>& repeats)
{
    Json list = Json::array();
    for (const Repeat& one : repeats)
        list.push_back({{"what", one.what}, {"commands", one.commands}});
    return list;
}

Json sessions_of(const Results& results)
{
    Json list = Json::array();
    for (const results::RecordedSession& session : results.sessions) {
        list.push_back({{"peers", {session.a.id, session.b.id}},
                        {"algorithm", session.algorithm},
                        {"played", sentence_of(session)},
                        {"valid", session.analysis.valid()},
                        {"invalid_because", session.analysis.invalid_because},
                        {"tables", json_of(tables_of(session.analysis))},
                        {"network", about_network(session)},
                        {"clock", about_clocks(session)},
                        {"settings", json_of({settings_table(session)})},
                        {"repeats", json_of(repeats_of(session))}});
    }
    return list;
}

/// Returns a sentence for each run. A run about which nothing is known has its title instead.
Json played_of(const Results& results)
{
    Json list = Json::array();
    for (const results::Run& run : results.runs) {
        auto sentence = sentence_of(run);
        const auto title = run.manifest.find("title");
        if (sentence.empty() && title != run.manifest.end() && title->is_string())
            sentence = title->get<std::string>() + ".";
        if (!sentence.empty()) list.push_back(std::move(sentence));
    }
    return list;
}

Json runs_of(const Results& results)
{
    Json list = Json::array();
    for (const results::Run& run : results.runs)
        list.push_back(
            {{"folder", run.folder}, {"manifest", run.manifest}, {"amounts", amounts_of(run)}});
    return list;
}

/// Returns the tables that a page shows as tables.
Json tables_of(const Results& results)
{
    constexpr std::array<std::string_view, 16> are_shown{
        "table1",           "tasks",          "limits",        "limits_by_convention",
        "paired",           "claims",         "precision",     "claims_numbers",
        "claims_quantiles", "claim_sessions", "tasks_by_axis", "limits_by_axis",
        "real_time",        "rankings",       "requirements",  "network_classes"};
    std::vector<results::Table> tables;
    for (const std::string_view name : are_shown)
        if (!results.table(name).is_empty()) tables.push_back(results.table(name));
    return Json::parse(results::json_text(tables)).at("tables");
}

/// The data of a page under construction: its contents, and its figures' own files.
class PageData {
public:
    explicit PageData(const Results& results) : results_{results}
    {
        Json sections = Json::array();
        for (const SectionKind& kind : section_kinds)
            if (auto section = section_of(kind); !section.is_null())
                sections.push_back(std::move(section));
        data_ = {{"subject", subject_of(results)},
                 {"title", title_of(results)},
                 {"sections", std::move(sections)},
                 {"played", played_of(results)},
                 {"runs", runs_of(results)},
                 {"tables", tables_of(results)},
                 {"sessions", sessions_of(results)},
                 {"interval_seeds_min", metrics::interval_seeds_min}};
        if (const auto criteria = results.criteria()) data_["criteria"] = json_of(*criteria);
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
    /// Returns the data of a section; null: it has none.
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
                add(figure, results_.files_of(source_of(kind)), group);
            }
            list.push_back({{"title", group.title}, {"figures", std::move(names)}});
        }
        return {
            {"id", kind.id},
            {"title", kind.title_of == nullptr ? std::string{kind.title} : kind.title_of(results_)},
            {"groups", list}};
    }

    /// Adds a figure. If no result file has its numbers, it gets a file of its own.
    void add(page::Figure figure, std::vector<std::string> sources, const FigureGroup& group)
    {
        if (figure.sources.empty()) figure.sources = std::move(sources);
        if (figure.sources.empty() && !std::holds_alternative<page::HeatMap>(figure.content)) {
            figure.sources = {fmt::format("figures/{}.csv", figure.id)};
            files_.push_back({figure.sources.front(), page::csv_of(page::json_of(figure))});
        }
        std::ranges::copy(group.origins, std::back_inserter(figure.sources));
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

std::vector<results::File> report_of(const results::Results& results)
{
    return PageData{results}.files();
}

} // namespace hapnet::lab::report
