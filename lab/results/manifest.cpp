// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/manifest.hpp"

#include "lab/experiment/text.hpp"
#include "proto/base/version.hpp"

#include <chrono>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab {

namespace {

using Json = nlohmann::ordered_json;

/// ISO 8601, UTC, whole seconds.
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

Json seeds_of(const Experiment& experiment)
{
    Json seeds = Json::array();
    for (std::uint32_t i = 0; i < experiment.seeds; ++i) {
        seeds.push_back(experiment.first_seed + i);
    }
    return seeds;
}

} // namespace

Json manifest_of(const Experiment& experiment, const Circumstances& circumstances)
{
    const double simulated_s =
        static_cast<double>(circumstances.played) * base::to_seconds(experiment.duration);
    Json speed_ratio; // null when nothing was played
    if (circumstances.played > 0 && circumstances.wall_time_s > 0.0) {
        speed_ratio = simulated_s / circumstances.wall_time_s;
    }
    return {{"command", circumstances.command},
            {"program", circumstances.program},
            {"version", base::version()},
            {"commit", base::commit()},
            {"compiler", base::compiler()},
            {"host", circumstances.host},
            {"start", utc_text(circumstances.start_s)},
            {"wall_time_s", circumstances.wall_time_s},
            {"kind", name_of(experiment.kind)},
            {"title", experiment.title},
            {"configuration", to_text(experiment)},
            {"criteria", circumstances.criteria},
            {"seeds", seeds_of(experiment)},
            {"valid", circumstances.invalid_because.empty()},
            {"invalid_because", circumstances.invalid_because},
            {"sessions", {{"played", circumstances.played}, {"reused", circumstances.reused}}},
            {"simulated_s", simulated_s},
            {"speed_ratio", speed_ratio}};
}

} // namespace hapnet::lab
