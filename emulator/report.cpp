// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/report.hpp"

#include "emulator/checks.hpp"
#include "emulator/control/settings.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/settings.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/direction_report.hpp"
#include "emulator/run_state.hpp"
#include "emulator/stream_json.hpp"
#include "proto/base/version.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

using Json = nlohmann::ordered_json;

Json text_of(const std::optional<net::Endpoint>& address)
{
    return address ? Json(address->to_text()) : Json(nullptr);
}

const ports::Relay& relay_of(const Run& run) { return *run.port.relays().front(); }

/// The changes that a path saw, each with the settings that changed. The generation is that of the
/// run where it has one path only.
Json changes_json(const std::vector<ConditionChange>& changes, std::string_view name)
{
    Json list = Json::array();
    for (const ConditionChange& change : changes) {
        Json json = Json::object();
        if (name.empty()) json["generation"] = change.generation;
        json["elapsed_s"] = base::to_seconds(change.elapsed);
        json["effective_at"] = {{"up", change.effective_up}, {"down", change.effective_down}};
        json["by"] = to_text(change.by);
        Json settings = Json::object();
        for (const auto& [key, value] :
             texts_of(Direction::up, change.patch(Direction::up), name)) {
            settings[key] = value;
        }
        for (const auto& [key, value] :
             texts_of(Direction::down, change.patch(Direction::down), name)) {
            settings[key] = value;
        }
        json["settings"] = std::move(settings);
        list.push_back(std::move(json));
    }
    return list;
}

/// What is missing in the files that were asked for.
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

std::string incomplete(const Recorder& recorder)
{
    std::string text;
    for (const std::string& lack : lacks_of(recorder))
        text += fmt::format("NOT COMPLETE: {}\n", lack);
    return text;
}

std::string failures_in_words(const RunState& state)
{
    std::string text;
    for (const std::string& failure : state.failures)
        text += fmt::format("NOT VALID: {}\n", failure);
    return text;
}

void add_validity(nlohmann::ordered_json& json, const AnyRun& run, std::vector<std::string> reasons)
{
    for (const std::string& lack : lacks_of(run.recorder))
        reasons.push_back(fmt::format("files: {}", lack));
    json["valid"] = reasons.empty();
    json["invalid_because"] = std::move(reasons);
}

nlohmann::ordered_json configuration_json(const Path& path)
{
    const auto of = [](Direction direction, const Conditions& conditions) {
        Json json = Json::object();
        for (const auto& [key, value] : texts_of(direction, to_patch(conditions))) {
            json[key.substr(key.find('.') + 1)] = value;
        }
        return json;
    };
    return {{"up", of(Direction::up, path.up)}, {"down", of(Direction::down, path.down)}};
}

nlohmann::ordered_json head_of(const AnyRun& run, const RunState& state)
{
    return {{"program", "hapnet-emulator"},
            {"version", base::version()},
            {"commit", base::commit()},
            {"compiler", base::compiler()},
            {"seed", run.scenario.seed.value()},
            {"timing", base::name_of(run.options.timing)},
            {"budget_us", json_in_us(run.options.budget)},
            {"duration_s", base::to_seconds(state.elapsed)},
            {"real_time",
             {{"fifo", run.real_time.fifo}, {"locked_memory", run.real_time.locked_memory}}}};
}

void add_course(nlohmann::ordered_json& json, const AnyRun& run, const PathState& path)
{
    json["configuration_at_start"] =
        configuration_json(profile_of(run.scenario.profile, path.name).path);
    json["configuration_at_end"] = configuration_json(*path.conditions);
    json["changes"] = changes_json(path.changes, path.name);
    json["changes_omitted"] = path.changes_omitted;
}

void add_files(nlohmann::ordered_json& json, const AnyRun& run)
{
    json["profile"] = to_text(run.scenario.profile);
    json["fates"] = or_null(run.options.fates);
    json["replay"] = or_null(run.options.replay);
    json["capture"] = or_null(run.options.capture);
    json["fates_lost"] = run.recorder.fates_lost();
    json["capture_lost"] = run.recorder.capture_lost();
}

nlohmann::ordered_json json_of_way(const WayState& way, const AnyRun& run, const RunState& state)
{
    DirectionOfRun direction = way.view();
    direction.has_distributions = state.is_over && run.options.fates.has_value();
    return json_of(direction, run.options.budget);
}

std::vector<std::string> reasons_against(const RunState& state, base::Duration budget)
{
    std::vector<std::string> reasons = state.failures;
    const PathState& path = state.paths.front();
    for (const auto& [way, one] : {std::pair{"up", &path.up}, std::pair{"down", &path.down}}) {
        for (const std::string& reason : reasons_against(one->view(), budget)) {
            reasons.push_back(fmt::format("{}: {}", way, reason));
        }
    }
    return reasons;
}

void add_checks(nlohmann::ordered_json& json, const AnyRun& run)
{
    const auto& checks = run.scenario.checks;
    if (!checks.empty()) json["checks"] = judged(checks, json);
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
    Json json = head_of(run, state);
    json["listen_a"] = relay_of(run).a().local.to_text();
    json["listen_b"] = relay_of(run).b().local.to_text();
    json["a"] = text_of(path.end_a);
    json["b"] = text_of(path.end_b);
    json["strangers"] = path.up.strangers + path.down.strangers;
    json["overflowed"] = path.up.overflowed + path.down.overflowed;
    json["generation"] = state.generation;
    add_course(json, run, path);
    add_files(json, run);
    add_validity(json, run, reasons_against(state, run.options.budget));
    json["up"] = json_of_way(path.up, run, state);
    json["down"] = json_of_way(path.down, run, state);
    add_checks(json, run);
    return json;
}

std::string summary(const Run& run, const RunState& state)
{
    const PathState& path = state.paths.front();
    return fmt::format("{:.1f} s, seed {}\n", base::to_seconds(state.elapsed),
                       run.scenario.seed.value()) +
           in_words("up   (A to B)", path.up.view(), run.options.budget) +
           in_words("down (B to A)", path.down.view(), run.options.budget) +
           incomplete(run.recorder) + failures_in_words(state);
}

std::string status_line(const Run& /*run*/, const RunState& state)
{
    const PathState& path = state.paths.front();
    return fmt::format("{:.0f} s | {} | {}", base::to_seconds(state.elapsed),
                       in_short("up", path.up.view()), in_short("down", path.down.view()));
}

} // namespace hapnet::emulator
