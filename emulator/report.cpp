// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/report.hpp"

#include "emulator/checks.hpp"
#include "emulator/control/settings.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/settings.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/direction_words.hpp"
#include "emulator/run_state.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/base/version.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

const ports::Relay& relay_of(const Run& run) { return *run.port.relays().front(); }

/// Returns the changes of a path, each with the settings that changed. The generation is that of
/// the run; it is set only if the run has one path.
std::vector<ChangeReport> changes_of(const std::vector<ConditionChange>& changes,
                                     std::string_view name)
{
    std::vector<ChangeReport> list;
    for (const ConditionChange& change : changes) {
        ChangeReport& report = list.emplace_back();
        if (parts_of(name).path.empty()) report.generation = change.generation;
        report.elapsed = change.elapsed;
        report.effective_at = {change.effective_up, change.effective_down};
        report.by = change.by;
        for (const Direction direction : {Direction::up, Direction::down}) {
            auto texts = texts_of(direction, change.patch(direction), name);
            std::ranges::move(texts, std::back_inserter(report.settings));
        }
    }
    return list;
}

/// Returns sentences on missing parts of the requested files.
std::vector<std::string> lacks_of(const Recorder& recorder)
{
    std::vector<std::string> lacks;
    if (recorder.has_failed()) lacks.emplace_back("a file of this run could not be written");
    if (const auto lost = recorder.fates_lost(); lost > 0)
        lacks.push_back(fmt::format("the fates lack {} datagrams", lost));
    if (const auto lost = recorder.capture_lost(); lost > 0)
        lacks.push_back(fmt::format("the capture lacks {} packets", lost));
    return lacks;
}

} // namespace

Configuration configuration_of(const Path& path)
{
    const auto of = [](Direction direction, const Conditions& conditions) {
        auto texts = texts_of(direction, to_patch(conditions));
        for (auto& [key, value] : texts) key.erase(0, key.find('.') + 1);
        return texts;
    };
    return {of(Direction::up, path.up), of(Direction::down, path.down)};
}

RunStatistics statistics_of_any(const AnyRun& run, const RunState& state)
{
    RunStatistics statistics;
    statistics.program = {.version = base::version(),
                          .commit = base::commit(),
                          .compiler = base::compiler(),
                          .seed = run.scenario.seed.value(),
                          .timing = base::name_of(run.options.timing),
                          .budget = run.options.budget,
                          .duration = state.elapsed,
                          .real_time = {run.real_time.fifo, run.real_time.locked_memory}};
    statistics.generation = state.generation;
    statistics.files = {.profile = to_text(run.scenario.profile),
                        .fates = run.options.fates,
                        .replay = run.options.replay,
                        .capture = run.options.capture,
                        .fates_lost = run.recorder.fates_lost(),
                        .capture_lost = run.recorder.capture_lost()};
    if (!state.is_over) statistics.elapsed = state.elapsed;
    return statistics;
}

CourseReport course_of(const AnyRun& run, const PathState& path)
{
    return {.at_start = configuration_of(profile_of(run.scenario.profile, path.name).path),
            .at_end = configuration_of(*path.conditions),
            .changes = changes_of(path.changes, path.name),
            .changes_omitted = path.changes_omitted};
}

DirectionReport report_of(const WayState& way, const AnyRun& run, const RunState& state)
{
    return {.statistics = &way.statistics,
            .stream = &way.stream,
            .strangers = way.strangers,
            .overflowed = way.overflowed,
            .unreachable = way.unreachable,
            .budget = run.options.budget,
            .has_distributions = state.is_over && run.options.fates.has_value()};
}

namespace {

/// Reports a direction of a path or of a flow; of a path with flows, only the traffic in no flow.
DirectionReport report_of_own(const PathState& path, Direction direction, const AnyRun& run,
                              const RunState& state)
{
    const bool is_up = direction == Direction::up;
    const WayState& way = is_up ? path.up : path.down;
    const Regimes& regimes = is_up ? path.conditions->up.regimes : path.conditions->down.regimes;
    DirectionReport report = report_of(way, run, state);
    report.regimes = regime_reports_of(regimes, way.regimes);
    return report;
}

} // namespace

DirectionReport report_of(const PathState& path, Direction direction, const AnyRun& run,
                          const RunState& state)
{
    const bool is_up = direction == Direction::up;
    auto report = report_of_own(path, direction, run, state);
    if (path.flows.empty()) return report;
    report.statistics = is_up ? &path.all_up : &path.all_down;
    report.stream = nullptr;
    report.has_distributions = false;
    report.regimes.reset();
    return report;
}

std::optional<FlowReports> flows_of(const PathState& path, const AnyRun& run, const RunState& state)
{
    if (path.flows.empty()) return std::nullopt;
    FlowReports flows;
    for (const PathState& flow : path.flows) {
        flows.emplace_back(std::string{parts_of(flow.name).flow},
                           FlowReport{.course = course_of(run, flow),
                                      .up = report_of_own(flow, Direction::up, run, state),
                                      .down = report_of_own(flow, Direction::down, run, state)});
    }
    // It is not known to which flow strangers, and datagrams that the socket lost, would belong.
    const auto rest_of = [&](Direction direction) {
        auto report = report_of_own(path, direction, run, state);
        report.strangers = report.overflowed = report.unreachable = 0;
        return report;
    };
    flows.emplace_back(std::string{rest_of_flows}, FlowReport{.course = course_of(run, path),
                                                              .up = rest_of(Direction::up),
                                                              .down = rest_of(Direction::down)});
    return flows;
}

void add_reasons(std::vector<std::string>& reasons, const std::optional<FlowReports>& flows)
{
    if (!flows) return;
    for (const auto& [name, flow] : *flows) {
        add_reasons(reasons, fmt::format("flow {}, up", name), flow.up);
        add_reasons(reasons, fmt::format("flow {}, down", name), flow.down);
    }
}

void judge(RunStatistics& statistics, const AnyRun& run, std::vector<std::string> reasons)
{
    for (const std::string& lack : lacks_of(run.recorder))
        reasons.push_back(fmt::format("files: {}", lack));
    statistics.is_valid = reasons.empty();
    statistics.invalid_because = std::move(reasons);
}

void add_reasons(std::vector<std::string>& reasons, std::string_view way,
                 const DirectionReport& report)
{
    for (const std::string& reason : report.reasons()) {
        reasons.push_back(fmt::format("{}: {}", way, reason));
    }
}

void tell_of_path(RunStatistics& statistics, const AnyRun& run, const RunState& state)
{
    const PathState& path = state.paths.front();
    statistics.course = course_of(run, path);
    statistics.up = report_of(path, Direction::up, run, state);
    statistics.down = report_of(path, Direction::down, run, state);
    statistics.flows = flows_of(path, run, state);
    if (statistics.flows) statistics.unknown_fragments = path.unknown_fragments;
    std::vector<std::string> reasons = state.failures;
    add_reasons(reasons, "up", statistics.up);
    add_reasons(reasons, "down", statistics.down);
    add_reasons(reasons, statistics.flows);
    judge(statistics, run, std::move(reasons));
}

nlohmann::ordered_json json_of(RunStatistics& statistics, const AnyRun& run)
{
    auto json = base::json_of(statistics);
    if (run.scenario.checks.empty()) return json;
    statistics.checks = judged(run.scenario.checks, json);
    json["checks"] = base::json_of(statistics.checks);
    return json;
}

std::string words_of_path(const AnyRun& run, const RunState& state)
{
    const PathState& path = state.paths.front();
    std::string text = in_words("up   (A to B)", report_of(path, Direction::up, run, state)) +
                       in_words("down (B to A)", report_of(path, Direction::down, run, state));
    for (const auto& [name, flow] : flows_of(path, run, state).value_or(FlowReports{})) {
        text += in_words(fmt::format("flow {}, up  ", name), flow.up) +
                in_words(fmt::format("flow {}, down", name), flow.down);
    }
    return text;
}

std::string closing_words(const AnyRun& run, const RunState& state)
{
    std::string text;
    for (const std::string& lack : lacks_of(run.recorder))
        text += fmt::format("NOT COMPLETE: {}\n", lack);
    for (const std::string& failure : state.failures)
        text += fmt::format("NOT VALID: {}\n", failure);
    return text;
}

std::string ready_line(const Run& run)
{
    return fmt::format("ready a={} b={} seed={} timing={}\n",
                       relay_of(run).a().socket.local().to_text(),
                       relay_of(run).b().socket.local().to_text(), run.scenario.seed.value(),
                       base::name_of(run.options.timing));
}

nlohmann::ordered_json statistics_of(const Run& run, const RunState& state)
{
    const PathState& path = state.paths.front();
    const auto text_of = [](const std::optional<net::Endpoint>& address) {
        return address ? std::optional{address->to_text()} : std::nullopt;
    };
    RunStatistics statistics = statistics_of_any(run, state);
    EndsReport& ends = statistics.ends;
    ends.listen_a = relay_of(run).a().local.to_text();
    ends.listen_b = relay_of(run).b().local.to_text();
    ends.a = text_of(path.end_a);
    ends.b = text_of(path.end_b);
    ends.strangers = path.up.strangers + path.down.strangers;
    ends.overflowed = path.up.overflowed + path.down.overflowed;
    tell_of_path(statistics, run, state);
    return json_of(statistics, run);
}

std::string summary(const Run& run, const RunState& state)
{
    return fmt::format("{:.1f} s, seed {}\n", base::to_seconds(state.elapsed),
                       run.scenario.seed.value()) +
           words_of_path(run, state) + closing_words(run, state);
}

std::string status_line(const Run& run, const RunState& state)
{
    const PathState& path = state.paths.front();
    return fmt::format("{:.0f} s | {} | {}", base::to_seconds(state.elapsed),
                       in_short("up", report_of(path, Direction::up, run, state)),
                       in_short("down", report_of(path, Direction::down, run, state)));
}

} // namespace hapnet::emulator
