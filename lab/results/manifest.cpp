// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/manifest.hpp"

#include "lab/experiment/text.hpp"
#include "proto/base/version.hpp"

#include <chrono>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::results {

namespace {

using Json = nlohmann::ordered_json;

Json seeds_of(const experiment::Experiment& experiment)
{
    Json seeds = Json::array();
    for (std::uint32_t i = 0; i < experiment.seeds; ++i) {
        seeds.push_back(experiment.first_seed + i);
    }
    return seeds;
}

/// Returns the length of a session; with recorded people, the mean over their trials.
double mean_length_s(const experiment::Experiment& experiment, const hands::Population* people)
{
    if (people == nullptr || !experiment.is_as_long_as_scripts)
        return base::to_seconds(experiment.duration);
    double sum_s = 0.0;
    for (const hands::Trial& trial : people->trials)
        sum_s += base::to_seconds(experiment::session_length(trial.end_s()));
    return sum_s / static_cast<double>(people->trials.size());
}

} // namespace

std::string utc_text(double since_1970_s)
{
    const std::chrono::sys_seconds time{
        std::chrono::seconds{static_cast<std::int64_t>(since_1970_s)}};
    const auto day = std::chrono::floor<std::chrono::days>(time);
    const std::chrono::year_month_day date{day};
    const std::chrono::hh_mm_ss clock{time - day};
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                       clock.hours().count(), clock.minutes().count(), clock.seconds().count());
}

Json manifest_head(const Circumstances& circumstances)
{
    Json head{{"command", circumstances.command}};
    if (!circumstances.program.empty()) head["program"] = circumstances.program;
    head["version"] = base::version();
    head["commit"] = base::commit();
    head["compiler"] = base::compiler();
    head["host"] = circumstances.host;
    head["start"] = circumstances.start;
    head["wall_time_s"] = circumstances.wall_time_s;
    if (circumstances.processor_time_s) head["processor_time_s"] = *circumstances.processor_time_s;
    return head;
}

Json make_manifest(const experiment::Experiment& experiment, const Circumstances& circumstances,
                   const RunOutcome& outcome)
{
    const double simulated_s =
        static_cast<double>(outcome.played) * mean_length_s(experiment, outcome.people.get());
    Json speed_ratio; // null when nothing was played
    if (outcome.played > 0 && circumstances.wall_time_s > 0.0) {
        speed_ratio = simulated_s / circumstances.wall_time_s;
    }
    Json manifest = manifest_head(circumstances);
    manifest.update({{"kind", name_of(experiment.kind)},
                     {"title", experiment.title},
                     {"configuration", to_text(experiment)},
                     {"criteria", outcome.criteria},
                     {"seeds", seeds_of(experiment)},
                     {"valid", outcome.invalid_because.empty()},
                     {"invalid_because", outcome.invalid_because},
                     {"sessions", {{"played", outcome.played}, {"reused", outcome.reused}}},
                     {"simulated_s", simulated_s},
                     {"speed_ratio", speed_ratio}});
    if (outcome.people) {
        manifest["people"] = {{"folder", outcome.people->folder},
                              {"subjects", outcome.people->subjects()},
                              {"trials", outcome.people->trials.size()}};
    }
    if (!outcome.digest.empty()) manifest["digest"] = outcome.digest;
    return manifest;
}

} // namespace hapnet::lab::results
