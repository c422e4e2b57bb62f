// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/report.hpp"

#include "lab/report/page.hpp"
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"
#include "proto/plot/axis.hpp"
#include "proto/plot/page.hpp"

#include <array>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

using plot::escaped;

namespace {

using Json = nlohmann::ordered_json;

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

/// The sections that there are, and as HTML what is missing.
struct Contents {
    std::vector<Section> sections;
    std::string missing;
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
            contents.missing += fmt::format("<li>{}: <code>{} {}/{}</code></li>\n", part.what,
                                            part.command, escaped(folder), part.subfolder);
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

/// Why a run is not valid, a line of HTML for each reason.
std::string reasons_of(const results::Run& run)
{
    if (run.is_valid()) return "";
    std::string reasons;
    const auto add = [&](const std::string& why) {
        reasons += fmt::format("<li>{}: {}</li>\n", escaped(run.folder), escaped(why));
    };
    const auto found = run.manifest.find("invalid_because");
    if (found == run.manifest.end() || !found->is_array() || found->empty()) {
        // Each row of the sessions over real UDP says it for itself.
        const bool is_real_time = run.manifest.value("kind", Json{}) == "real-time";
        add(is_real_time ? "not every session over real UDP kept its timing" : "does not say why");
        return reasons;
    }
    for (const auto& reason : *found) {
        add(reason.is_string() ? reason.get<std::string>() : reason.dump());
    }
    return reasons;
}

/// Whether the results count, and why not. Recorded sessions say so themselves.
std::string validity(const results::Results& results)
{
    std::string reasons;
    for (const results::Run& run : results.runs) reasons += reasons_of(run);
    if (!reasons.empty()) {
        return "<div class='banner missed' role='alert'><b>Not valid.</b> These numbers do not "
               "count:<ul>\n" +
               reasons + "</ul></div>\n";
    }
    if (!results.runs.empty()) {
        return "<div class='banner met'><b>Valid.</b> All runs completed and passed their own "
               "validity checks.</div>\n";
    }
    if (subject_of(results) == Subject::session) return "";
    return "<div class='banner'>There is no manifest.json: it is not known how these numbers came "
           "about and whether they are valid.</div>\n";
}

std::string tile(std::size_t count, std::string_view text, std::string_view style)
{
    return fmt::format("<a class='tile {}' href='#claims'><b>{}</b> {}</a>\n", style, count, text);
}

/// What stands on top: what one sees, and whether it counts.
std::string head_of(const results::Results& results, const std::string& title,
                    const Contents& contents)
{
    const Claims claims = main_claims(results);
    std::string out = fmt::format("<header>\n<h1>{}</h1>\n<p class='lead'>{}</p>\n{}",
                                  escaped(title), lead_of(subject_of(results)), validity(results));
    if (!claims.are_none()) {
        const std::size_t seen = claims.selected.size() + claims.by_construction.size();
        out += fmt::format("<p class='tiles' aria-label='results that stand against the paper'>\n"
                           "{}{}{}{}{}</p>\n",
                           tile(claims.calibrated.size(), "calibrated", "calibrated"),
                           tile(seen, "selected, or by construction", "seen"),
                           tile(claims.met.size(), "predicted and met", "met"),
                           tile(claims.undecided.size(), "undecided", "seen"),
                           tile(claims.missed.size(), "missed", "missed"));
    }
    out += "<nav aria-label='contents'><ul>\n";
    for (const Section& section : contents.sections) {
        out += fmt::format("<li><a href='#{}'>{}</a></li>\n", section.id, escaped(section.title));
    }
    return out + "</ul></nav>\n</header>\n";
}

/// All that the page's script draws, in one element.
std::string figures_data(const Contents& contents)
{
    Json all = Json::object();
    for (const Section& section : contents.sections) {
        for (const Figure& one : section.figures) {
            if (!one.data.is_null()) all[one.name] = one.data;
        }
    }
    if (all.empty()) return "";
    return fmt::format("<script type='application/json' id='figures'>{}</script>\n",
                       in_script(all));
}

std::string page_of(const results::Results& results, const Contents& contents)
{
    const std::string title = title_of(results);
    const Subject subject = subject_of(results);
    std::string page =
        plot::page_head(title, name_of(subject), page_style()) + head_of(results, title, contents);
    for (const Section& section : contents.sections) {
        page += fmt::format("<section id='{0}' aria-labelledby='{0}-title'>\n"
                            "<h2 id='{0}-title'>{1}</h2>\n{2}</section>\n",
                            section.id, escaped(section.title), section.html);
    }
    if (!contents.missing.empty()) {
        page += "<section id='missing'>\n<h2>Not in this folder</h2>\n<p>These commands make the "
                "rest; report the folder again afterwards.</p>\n<ul>\n" +
                contents.missing + "</ul>\n</section>\n";
    }
    if (subject != Subject::session) {
        page += "<footer><p>The hands are simulated. A verdict is a calibrated convention, not a "
                "finding about people.</p></footer>\n";
    }
    const std::string figures = figures_data(contents);
    const std::string modules =
        page_modules({.has_figures = !figures.empty(), .has_player = !results.replays.empty()});
    return page + figures + modules +
           plot::page_foot(modules.empty() ? std::string_view{} : loader_script());
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
    Contents contents = contents_of(results, folder);
    std::vector<results::File> files{{"report.html", page_of(results, contents)}};
    for (const Section& section : contents.sections) {
        for (const Figure& one : section.figures) {
            files.push_back({fmt::format("figures/{}.svg", one.name), plot::standalone(one.svg)});
            if (!one.csv.empty())
                files.push_back({fmt::format("figures/{}.csv", one.name), one.csv});
        }
    }
    return files;
}

} // namespace hapnet::lab::report
