// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/report.hpp"

#include "lab/report/player.hpp"
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

#include <array>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

namespace {

/// What a page can have, and how to make it.
struct PartOfPage {
    std::string_view what;
    std::optional<Section> (*section)(const results::Results&);
    std::string_view command; // up to the folder; empty: it comes with others
    std::string_view subfolder{};
};

constexpr std::array parts_of_page{
    PartOfPage{"the demo", demo_section, ""},
    PartOfPage{"the replay", replay_section, "scripts/table1.sh --out", "table1"},
    PartOfPage{"recorded sessions", session_section, ""},
    PartOfPage{"Table 1", table1_section, "scripts/table1.sh --out", "table1"},
    PartOfPage{"Fig. 6a", fig6a_section, "scripts/fig6a.sh --out", "fig6a"},
    PartOfPage{"Fig. 6b", fig6b_section, "scripts/fig6b.sh --out", "fig6b"},
    PartOfPage{"the curves", curves_section, "scripts/fig6a.sh --out", "fig6a"},
    PartOfPage{"how far a limit can be trusted", trust_section, "scripts/fig6a.sh --out", "fig6a"},
    PartOfPage{"what accuracy costs", precision_section, ""},
    PartOfPage{"what was not chosen", axis_section, ""},
    PartOfPage{"conditions varied together", points_section, ""},
    PartOfPage{"algorithms seed by seed", paired_section, ""},
    PartOfPage{"Fig. 7", fig7_section, "scripts/fig7.sh --out", "fig7"},
    PartOfPage{"what a network must offer", qos_section, "scripts/qos.sh --out", "qos"},
    PartOfPage{"the closed-loop tasks", tasks_section, "scripts/table1.sh --out", "table1"},
    PartOfPage{"real time", real_time_section, "scripts/table1.sh --real-time --out", "table1"},
    PartOfPage{"what stands against the paper", claims_section, ""},
    PartOfPage{"what is claimed beyond the paper", beyond_section, "scripts/beat.sh --out", "beat"},
    PartOfPage{"how to repeat it", runs_section, ""}};

/// The sections that there are, and what is missing.
struct Contents {
    std::vector<Section> sections;
    std::vector<Json> missing;
};

/// What a page is about. A page about one thing does not replace one about another unnoticed.
enum class Subject : std::uint8_t { experiments, demo, session };

Subject subject_of(const results::Results& results)
{
    if (results.demo) return Subject::demo;
    const bool has_sessions_only = !results.sessions.empty() && results.runs.empty();
    return has_sessions_only ? Subject::session : Subject::experiments;
}

std::string_view name_of(Subject subject)
{
    switch (subject) {
    case Subject::experiments: return "experiments";
    case Subject::demo: return "demo";
    case Subject::session: return "session";
    }
    return "";
}

Contents contents_of(const results::Results& results, std::string_view folder)
{
    Contents contents;
    const bool is_of_experiments = subject_of(results) == Subject::experiments;
    for (const PartOfPage& part : parts_of_page) {
        if (auto section = part.section(results)) {
            contents.sections.push_back(*std::move(section));
        } else if (!part.command.empty() && is_of_experiments) {
            contents.missing.push_back(page::text_of(
                {fmt::format("{}: ", part.what),
                 page::code(fmt::format("{} {}/{}", part.command, folder, part.subfolder))}));
        }
    }
    return contents;
}

std::string title_of(const results::Results& results)
{
    if (results.runs.size() == 1) {
        const auto& manifest = results.runs.front().manifest;
        const auto title = manifest.find("title");
        if (title != manifest.end() && title->is_string()) return title->get<std::string>();
    }
    if (subject_of(results) != Subject::session) return "Two people, one cube, a bad network";
    if (results.sessions.size() > 1) return "Recorded sessions";
    const std::string& task = results.sessions.front().task;
    return task.empty() ? "A recorded session" : "A recorded session of task " + task;
}

std::string_view lead_of(Subject subject)
{
    switch (subject) {
    case Subject::experiments:
        return "Two simulated hands push one cube over a bad network; each computer has its own "
               "copy of the cube, and this page shows how far the copies drift apart and when the "
               "push stops feeling right, beside the paper’s numbers.";
    case Subject::demo:
        return "Two simulated hands push one cube through the emulator, over real UDP, under the "
               "paper’s 160 ms. This page shows how far the two copies of the cube drift apart, "
               "beside the paper’s numbers.";
    case Subject::session:
        return "Two hands push one cube over a network; each computer has its own copy of the "
               "cube. This page shows what the two records say: how far the copies drift apart, "
               "what the network did, and whether the run counts.";
    }
    return "";
}

/// Why a run is not valid.
void add_reasons(std::vector<Json>& reasons, const results::Run& run)
{
    if (run.is_valid()) return;
    const auto add = [&](const std::string& why) {
        reasons.emplace_back(fmt::format("{}: {}", run.folder, why));
    };
    const auto found = run.manifest.find("invalid_because");
    if (found == run.manifest.end() || !found->is_array() || found->empty()) {
        // Each row of the sessions over real UDP says it for itself.
        const bool is_real_time = run.manifest.value("kind", Json{}) == "real-time";
        add(is_real_time ? "not every session over real UDP kept its timing" : "does not say why");
        return;
    }
    for (const auto& reason : *found)
        add(reason.is_string() ? reason.get<std::string>() : reason.dump());
}

/// The banner that says whether the results are valid, and why not. null for recorded sessions:
/// their own sections say it.
Json validity(const results::Results& results)
{
    std::vector<Json> reasons;
    for (const results::Run& run : results.runs) add_reasons(reasons, run);
    if (!reasons.empty()) {
        return page::banner(
            "missed", page::text_of({page::bold("Not valid."), " These numbers do not count:"}),
            std::move(reasons));
    }
    if (!results.runs.empty()) {
        return page::banner(
            "met", page::text_of({page::bold("Valid."), " All runs completed and passed their own "
                                                        "validity checks."}));
    }
    if (subject_of(results) == Subject::session) return nullptr;
    return page::banner("", "There is no manifest.json: it is not known how these numbers came "
                            "about and whether they are valid.");
}

Json tile(std::size_t count, std::string_view text, std::string_view style)
{
    return Json::object({{"count", count}, {"text", text}, {"style", style}});
}

/// The number of results for each verdict against the paper; null where there are none.
Json tiles_of(const Claims& claims)
{
    if (claims.are_none()) return nullptr;
    Json block = Json::object();
    block["tiles"] = Json::array({tile(claims.calibrated.size(), "calibrated", "calibrated"),
                                  tile(claims.selected.size() + claims.by_construction.size(),
                                       "selected, or by construction", "seen"),
                                  tile(claims.met.size(), "predicted and met", "met"),
                                  tile(claims.undecided.size(), "undecided", "seen"),
                                  tile(claims.missed.size(), "missed", "missed")});
    return block;
}

page::Page page_of(const results::Results& results, Contents contents)
{
    const Subject subject = subject_of(results);
    page::Page page{std::string{name_of(subject)}, title_of(results),
                    std::string{lead_of(subject)}};
    for (Json block : {validity(results), tiles_of(main_claims(results))})
        if (!block.is_null()) page.head.push_back(std::move(block));
    page.sections = std::move(contents.sections);
    if (!contents.missing.empty()) {
        auto& section = page.sections.emplace_back(page::Section{"missing", "Not in this folder"});
        section.add(page::paragraph("These commands make the rest; report the folder again "
                                    "afterwards."));
        section.add(page::list_of(std::move(contents.missing)));
    }
    if (subject != Subject::session) {
        page.foot = "The hands are simulated. A verdict is a calibrated convention, not a finding "
                    "about people.";
    }
    page.replays = replays_of(results);
    return page;
}

/// Writes the numbers of the figures that no result file has.
std::vector<results::File> tables_of(std::vector<page::Section>& sections)
{
    std::vector<results::File> files;
    for (page::Section& section : sections) {
        for (page::Figure& figure : section.figures) {
            const bool is_map = std::holds_alternative<page::HeatMap>(figure.content);
            if (!figure.sources.empty() || is_map) continue;
            const std::string path = fmt::format("figures/{}.csv", figure.id);
            files.push_back({path, page::csv_of(json_of(figure))});
            figure.sources = {path};
        }
    }
    return files;
}

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
    page::Page page = page_of(results, contents_of(results, folder));
    std::vector<results::File> tables = tables_of(page.sections);
    const auto player = page.replays.is_null() ? std::span<const page::Asset>{} : player_assets();
    std::vector<results::File> files{{"report.html", html_of(page, player)}};
    files.insert(files.end(), tables.begin(), tables.end());
    return files;
}

std::vector<std::string> files_named(const results::Results& results, std::string_view name)
{
    std::vector<std::string> files;
    for (const std::string& file : results.files) {
        if (file.substr(file.rfind('/') + 1) == name) files.push_back(file);
    }
    return files;
}

} // namespace hapnet::lab::report
