// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/report.hpp"

#include "emulator/checks.hpp"
#include "emulator/control/settings.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/settings.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/direction_report.hpp"
#include "emulator/stream_json.hpp"
#include "proto/base/version.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

using Json = nlohmann::ordered_json;

Json address_of(const ports::Relay::Side& side)
{
    const auto& address = side.filter.address();
    return address ? Json(address->to_text()) : Json(nullptr);
}

const ports::Relay& relay_of(const Run& run) { return *run.port.relays().front(); }

/// The last `count_max` of the changes that a path saw, each with the settings that changed. The
/// generation is that of the run where it has one path only.
Json changes_json(const ChangeLog& changes, std::size_t count_max, std::string_view name)
{
    Json list = Json::array();
    const std::span all{changes.entries()};
    for (const ConditionChange& change : all.last(std::min(all.size(), count_max))) {
        Json json = Json::object();
        if (name.empty()) json["generation"] = change.generation;
        json["elapsed_s"] = base::to_seconds(change.elapsed);
        json["effective_at"] = {{"up", change.effective_up}, {"down", change.effective_down}};
        json["by"] = to_text(change.by);
        Json settings = Json::object();
        for (const auto& [key, value] : texts_of(Direction::up, change.up, name)) {
            settings[key] = value;
        }
        for (const auto& [key, value] : texts_of(Direction::down, change.down, name)) {
            settings[key] = value;
        }
        json["settings"] = std::move(settings);
        list.push_back(std::move(json));
    }
    return list;
}

} // namespace

DirectionOfRun direction_of(const ports::Relay::Side& side)
{
    return {side.link.statistics(), &side.link.stream_statistics(), side.strangers,
            side.socket.overflowed()};
}

std::string incomplete(const Recorder& recorder)
{
    std::string text;
    if (recorder.has_failed()) text += "NOT COMPLETE: a file of this run could not be written\n";
    if (const auto lost = recorder.fates_lost(); lost > 0) {
        text += fmt::format("NOT COMPLETE: the fates lack {} datagrams\n", lost);
    }
    if (const auto lost = recorder.capture_lost(); lost > 0) {
        text += fmt::format("NOT COMPLETE: the capture lacks {} packets\n", lost);
    }
    return text;
}

std::string failures_in_words(const AnyRun& run)
{
    std::string text;
    for (const std::string& failure : run.failures) text += fmt::format("NOT VALID: {}\n", failure);
    return text;
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

nlohmann::ordered_json head_of(const AnyRun& run)
{
    return {{"program", "hapnet-emulator"},
            {"version", base::version()},
            {"commit", base::commit()},
            {"compiler", base::compiler()},
            {"seed", run.scenario.seed.value()},
            {"timing", to_text(run.options.timing)},
            {"budget_us", json_in_us(run.options.budget)},
            {"duration_s", base::to_seconds(run.elapsed)},
            {"real_time",
             {{"fifo", run.real_time.fifo}, {"locked_memory", run.real_time.locked_memory}}}};
}

void add_course(nlohmann::ordered_json& json, const AnyRun& run, const EmulatedPath& path,
                std::string_view name)
{
    // Clients may ask for them many times a second, and the relay answers.
    constexpr std::size_t while_it_runs = 20;
    const auto share = std::max(while_it_runs / run.paths.all().size(), std::size_t{1});
    const ChangeLog& log = path.changes();
    Json changes = changes_json(log, run.is_over ? ChangeLog::entries_max : share, name);
    const auto omitted = log.omitted() + (log.entries().size() - changes.size());
    json["configuration_at_start"] =
        configuration_json(profile_of(run.scenario.profile, name).path);
    json["configuration_at_end"] = configuration_json(path.director().path());
    json["changes"] = std::move(changes);
    json["changes_omitted"] = omitted;
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

nlohmann::ordered_json json_of_way(DirectionOfRun direction, const AnyRun& run)
{
    direction.has_distributions = run.is_over && run.options.fates.has_value();
    return json_of(direction, run.options.budget);
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
                       to_text(run.options.timing));
}

nlohmann::ordered_json statistics_of(const Run& run)
{
    const ports::Relay::Side& a = relay_of(run).a();
    const ports::Relay::Side& b = relay_of(run).b();
    std::vector<std::string> reasons = run.failures;
    for (const auto& [way, side] : {std::pair{"up", &a}, std::pair{"down", &b}}) {
        for (const std::string& reason : reasons_against(direction_of(*side), run.options.budget)) {
            reasons.push_back(fmt::format("{}: {}", way, reason));
        }
    }
    Json json = head_of(run);
    json["listen_a"] = a.socket.local().to_text();
    json["listen_b"] = b.socket.local().to_text();
    json["a"] = address_of(a);
    json["b"] = address_of(b);
    json["strangers"] = a.strangers + b.strangers;
    json["overflowed"] = a.socket.overflowed() + b.socket.overflowed();
    json["generation"] = run.paths.generation();
    add_course(json, run, *run.paths.all().front()->path, "");
    add_files(json, run);
    json["valid"] = reasons.empty();
    json["invalid_because"] = reasons;
    json["up"] = json_of_way(direction_of(a), run);
    json["down"] = json_of_way(direction_of(b), run);
    add_checks(json, run);
    return json;
}

std::string summary(const Run& run)
{
    return fmt::format("{:.1f} s, seed {}\n", base::to_seconds(run.elapsed),
                       run.scenario.seed.value()) +
           in_words("up   (A to B)", direction_of(relay_of(run).a()), run.options.budget) +
           in_words("down (B to A)", direction_of(relay_of(run).b()), run.options.budget) +
           incomplete(run.recorder) + failures_in_words(run);
}

std::string status_line(const Run& run)
{
    return fmt::format("{:.0f} s | {} | {}", base::to_seconds(run.elapsed),
                       in_short("up", direction_of(relay_of(run).a())),
                       in_short("down", direction_of(relay_of(run).b())));
}

} // namespace hapnet::emulator
