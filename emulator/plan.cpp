// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/plan.hpp"

#include "emulator/core/profile/regimes.hpp"

#include <algorithm>
#include <memory>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

Plan plan_of(const Options& options, const Scenario& scenario, std::size_t paths,
             base::TimePoint start)
{
    const std::size_t threads = std::min(options.threads, paths);
    const std::size_t ways = paths * (scenario.profile.flows.size() + 1);
    Plan plan{
        .options = options,
        .scenario = scenario,
        .files = {.fates = options.fates,
                  .capture = options.capture,
                  .kept = options.keep.span,
                  .keep_in = options.keep.folder,
                  .columns = {.has_paths = true,
                              .has_flows = !scenario.profile.flows.empty(),
                              .has_regimes = has_regimes(scenario.profile)},
                  .regimes = regimes_of_paths(scenario.profile),
                  .lanes = threads},
        .parts = {threads,
                  {.seed = scenario.seed,
                   .start = start,
                   .limits = QueueLimits::shared(options.in_flight_bytes, ways),
                   .replay = scenario.replay,
                   .stream_detail = options.fates ? StreamDetail::over_time : StreamDetail::totals,
                   .changes_max = std::max(ChangeLog::entries_max / ways, std::size_t{20})}}};
    for (Paths::Setup& part : plan.parts) {
        part.slab = std::make_shared<Slab>(options.in_flight_bytes / threads);
    }
    return plan;
}

CaptureNames capture_names(const std::string& first, const std::string& second)
{
    const auto name = [](const std::string& of, const std::string& to) {
        return fmt::format("{} (to {})", of, to);
    };
    return {name(first, second), name(second, first)};
}

} // namespace hapnet::emulator
