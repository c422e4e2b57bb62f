// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/played.hpp"

#include "lab/experiment/claims.hpp"
#include "lab/experiment/session_spec.hpp"
#include "lab/experiment/text.hpp"
#include "lab/hands/manifest.hpp"
#include "lab/report/patterns.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::lab::report {

namespace {

using experiment::Experiment;
using Words = std::vector<std::string>;

/// Joins words as "a, b and c".
std::string listed(const Words& words)
{
    if (words.size() < 2) return words.empty() ? "" : words.front();
    std::string text;
    for (std::size_t i = 0; i + 1 < words.size(); ++i) text += (i > 0 ? ", " : "") + words[i];
    return text + " and " + words.back();
}

std::string counted(std::size_t count, std::string_view one)
{
    return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

std::string tasks_of(const Experiment& experiment)
{
    Words names;
    const bool plays_p1 =
        std::ranges::find(experiment.tasks, device::Task::p1) != experiment.tasks.end();
    if (std::holds_alternative<experiment::Table1>(experiment.kind) && !plays_p1)
        names.emplace_back("P1");
    for (const device::Task task : experiment.tasks) names.emplace_back(name_of(task));
    return fmt::format("task{} {}", names.size() == 1 ? "" : "s", listed(names));
}

/// True if an axis varies one of these keys, or a key below it.
bool varies(const Experiment& experiment, std::initializer_list<std::string_view> keys)
{
    return std::ranges::any_of(experiment.axes, [&](const experiment::Axis& axis) {
        return std::ranges::any_of(keys,
                                   [&](std::string_view key) { return axis.key.starts_with(key); });
    });
}

bool varies_network(const Experiment& experiment)
{
    return varies(experiment, {"both.", "up.", "down."});
}

/// Returns "160 ms" for "160ms". A text that does not begin with a digit stays as it is.
std::string spaced(std::string_view text)
{
    const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
    const auto is_unit = [](char c) { return (c >= 'a' && c <= 'z') || c == '%'; };
    std::string out;
    bool is_number = false; // true while the current word is a number
    for (const char c : text) {
        if (is_number && is_unit(c)) out += ' ';
        is_number = is_digit(c) && (is_number || out.empty() || out.back() == ' ');
        out += c;
    }
    return out;
}

std::string network_of(const Experiment& experiment)
{
    if (varies_network(experiment)) return "";
    emulator::Profile profile;
    profile.path = experiment.path;
    return network_in_words(profile);
}

/// Describes what a kind of experiment varies, or the conditions of all sessions.
struct Circumstances {
    const Experiment& experiment;

    std::string operator()(const experiment::Limits& limits) const
    {
        Words ranges;
        for (const experiment::SearchRange& range : ranges_of(limits)) {
            ranges.push_back(fmt::format("{} from {} to {} {}",
                                         people_say(name_of(range.impairment)), to_text(range.from),
                                         to_text(range.to), people_say(unit_of(range.impairment))));
        }
        return fmt::format("under {}, to find where half of the sessions fail", listed(ranges));
    }
    std::string operator()(const experiment::ImpairmentGrid& grid) const
    {
        return fmt::format("at every combination of {}, {} of jitter and {} of loss",
                           counted(grid.delays.size(), "delay"),
                           counted(grid.jitters.size(), "level"),
                           counted(grid.losses.size(), "level"));
    }
    std::string operator()(const experiment::Claims& /*kind*/) const
    {
        return fmt::format("under the {} of the claims",
                           counted(experiment::claim_cells().size(), "condition"));
    }
    template <typename Kind>
    std::string operator()(const Kind& /*kind*/) const
    {
        const std::string network = network_of(experiment);
        if (!network.empty()) return "under " + network;
        return varies_network(experiment) ? "" : "on a perfect network";
    }
};

std::string axes_of(const Experiment& experiment)
{
    Words axes;
    for (const experiment::Axis& axis : experiment.axes) {
        const std::string what{people_say(axis.key)};
        if (!axis.values.empty()) {
            Words values;
            for (const std::string& value : axis.values) values.push_back(spaced(value));
            axes.push_back(fmt::format("{} varied ({})", what, listed(values)));
        } else if (axis.from && axis.to) {
            axes.push_back(
                fmt::format("{} varied from {} to {}", what, spaced(*axis.from), spaced(*axis.to)));
        }
    }
    return axes.empty() ? "" : "with " + listed(axes);
}

/// Describes the numbers of scenes and peers if they are not the usual ones.
std::string party_of(const Experiment& experiment)
{
    std::string text;
    if (!experiment.scenes.empty()) {
        Words names;
        for (const experiment::NamedScene& scene : experiment.scenes) names.push_back(scene.name);
        text += " in " + listed(names);
    }
    if (experiment.peers != std::vector<std::uint32_t>{2}) {
        Words counts;
        for (const std::uint32_t count : experiment.peers) counts.push_back(std::to_string(count));
        text += fmt::format(" with {} peers", listed(counts));
    }
    return text;
}

/// Returns "18 trials of 9 people" if recorded hands played; otherwise empty.
std::string people_of(const results::Run& run)
{
    const auto found = run.manifest.find("people");
    if (found == run.manifest.end() || !found->is_object()) return "";
    const auto count = [&](const char* key) {
        const auto value = found->find(key);
        return value != found->end() && value->is_number_unsigned() ? value->get<std::size_t>() : 0;
    };
    const auto subjects = count("subjects");
    return fmt::format("{} of {}", counted(count("trials"), "trial"),
                       subjects == 1 ? "1 subject" : fmt::format("{} subjects", subjects));
}

/// Describes the hands that played: "Simulated hands (nominal)".
std::string hands_of(const Experiment& experiment, const std::string& people)
{
    const bool is_varied = varies(experiment, {"hands"});
    if (is_varied && !people.empty())
        return fmt::format("Hands, simulated ones and those of recorded people ({}),", people);
    if (experiment.hands.people) return fmt::format("Hands of recorded people ({})", people);
    const bool has_hands =
        !std::holds_alternative<experiment::Claims>(experiment.kind) && !is_varied;
    return fmt::format("Simulated hands{}",
                       has_hands ? fmt::format(" ({})", name_of(experiment.hands)) : "");
}

std::string words_of(const Experiment& experiment, const std::string& people)
{
    Words algorithms;
    for (const auto& one : experiment.algorithms) algorithms.push_back(one.name);
    std::string text =
        fmt::format("{} played {}{} with the algorithm{} {}", hands_of(experiment, people),
                    tasks_of(experiment), party_of(experiment), algorithms.size() == 1 ? "" : "s",
                    listed(algorithms));
    for (const std::string& part :
         {std::visit(Circumstances{experiment}, experiment.kind), axes_of(experiment)})
        if (!part.empty()) text += ", " + part;
    if (!varies(experiment, {"duration"}))
        text += fmt::format(", in sessions of {:g} s", base::to_seconds(experiment.duration));
    text += fmt::format("; {}{}.", counted(experiment.seeds, "seed"),
                        people.empty() ? "" : " for each trial");
    if (people.empty()) return text;
    return text + " The people moved without Hapnet: none of them reacted to its forces. Hands "
                  "that follow their recordings give way to a force as the simulated hand does.";
}

/// Returns contents that can be read as a file of this name, whatever the real file holds. The
/// sentence needs only the names of scenes, of hands' motions and of people.
base::Result<std::string> any_file(const std::string& name)
{
    if (name.ends_with(".csv")) return std::string{"time_s,x_m,y_m,z_m\n0,0,0,0\n1,0,0,0\n"};
    if (name.ends_with(hands::manifest_name)) {
        hands::ImportedTrial trial;
        trial.subject = trial.trial = "1";
        trial.a.script = "1.csv";
        hands::Manifest manifest;
        put(manifest, trial);
        return to_text(manifest);
    }
    return scene::to_text(scene::paper_scene());
}

base::Result<Experiment> experiment_of(const results::Run& run)
{
    const auto found = run.manifest.find("configuration");
    if (found == run.manifest.end() || !found->is_string()) return base::fail("no configuration");
    return experiment::parse_experiment(found->get<std::string>(), "configuration", {}, any_file);
}

base::Result<Experiment> built_in(std::string_view name)
{
    const base::OpenFile none = [](const std::string& file) { return base::fail(file); };
    return experiment::load_experiment(std::string{name}, none, {});
}

/// Returns the built-in experiment of that title; nullopt for a user's own.
std::optional<Experiment> built_in_titled(const std::string& title)
{
    for (const experiment::BuiltInExperiment& one : experiment::built_in_experiments()) {
        auto found = built_in(one.name);
        if (found && found->title == title) return std::move(*found);
    }
    return std::nullopt;
}

/// Returns the name of the built-in experiment whose seeds and seconds settle a limit or a claim;
/// "" for other kinds.
std::string_view built_in_of(const experiment::Kind& kind)
{
    if (std::holds_alternative<experiment::Claims>(kind)) return "beat";
    return std::holds_alternative<experiment::Limits>(kind) ? "fig6a" : "";
}

page::Json amount_of(const Experiment& experiment)
{
    return {{"seeds", experiment.seeds}, {"duration_s", base::to_seconds(experiment.duration)}};
}

} // namespace

std::string network_in_words(const emulator::Profile& profile)
{
    emulator::Profile start;
    start.path = profile.path;
    std::string text = experiment::network_text(start);
    for (const auto& [from, to] :
         std::vector<std::pair<std::string_view, std::string_view>>{{"[both]; ", ""},
                                                                    {"[up]; ", "A to B: "},
                                                                    {"[down]; ", "B to A: "},
                                                                    {" = ", " "},
                                                                    {"\"", ""},
                                                                    {";", ","}}) {
        for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
            text.replace(at, from.size(), to);
    }
    text = spaced(text);
    if (profile.timeline.empty()) return text;
    return (text.empty() ? "nothing" : text) + " at the start, and other conditions later";
}

std::string sentence_of(const results::Run& run)
{
    const auto experiment = experiment_of(run);
    return experiment ? words_of(*experiment, people_of(run)) : "";
}

page::Json amounts_of(const results::Run& run)
{
    const auto experiment = experiment_of(run);
    if (!experiment) return nullptr;
    page::Json amounts{{"played", amount_of(*experiment)}};
    const auto same = built_in_titled(experiment->title);
    amounts["built_in"] = same.has_value();
    const std::string_view name = built_in_of(experiment->kind);
    if (same)
        amounts["meant"] = amount_of(*same);
    else if (const auto meant = built_in(name); !name.empty() && meant)
        amounts["meant"] = amount_of(*meant);
    return amounts;
}

std::string own_title_of(const results::Run& run)
{
    const auto title = run.manifest.find("title");
    if (title == run.manifest.end() || !title->is_string()) return "";
    const auto experiment = experiment_of(run);
    const auto same = built_in_titled(title->get<std::string>());
    const bool is_another = experiment && same && !experiment->axes.empty() && same->axes.empty();
    return is_another ? "" : title->get<std::string>();
}

} // namespace hapnet::lab::report
