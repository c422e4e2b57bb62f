// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/report.hpp"

#include "emulator/checks.hpp"
#include "emulator/control/settings.hpp"
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

DirectionOfRun direction_of(const ports::Relay::Side& side)
{
    return {side.link.statistics(), &side.link.stream_statistics(), side.strangers,
            side.socket.overflowed()};
}

/// A run that keeps each fate keeps whole distributions, too.
nlohmann::ordered_json direction_json(const ports::Relay::Side& side, const Run& run)
{
    DirectionOfRun direction = direction_of(side);
    direction.has_distributions = run.is_over && run.options.fates.has_value();
    return json_of(direction, run.options.budget);
}

Json address_of(const ports::Relay::Side& side)
{
    const auto& address = side.filter.address();
    return address ? Json(address->to_text()) : Json(nullptr);
}

/// What is missing in the files that were asked for.
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

} // namespace

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

nlohmann::ordered_json changes_json(const ChangeLog& changes, std::size_t count_max)
{
    Json list = Json::array();
    const std::span all{changes.entries()};
    for (const ConditionChange& change : all.last(std::min(all.size(), count_max))) {
        Json settings = Json::object();
        for (const auto& [key, value] : texts_of(Direction::up, change.up)) settings[key] = value;
        for (const auto& [key, value] : texts_of(Direction::down, change.down)) {
            settings[key] = value;
        }
        list.push_back(
            {{"generation", change.generation},
             {"elapsed_s", base::to_seconds(change.elapsed)},
             {"effective_at", {{"up", change.effective_up}, {"down", change.effective_down}}},
             {"by", to_text(change.by)},
             {"settings", std::move(settings)}});
    }
    return list;
}

std::string ready_line(const Run& run)
{
    return fmt::format("ready a={} b={} seed={} timing={}\n",
                       run.relay.a().socket.local().to_text(),
                       run.relay.b().socket.local().to_text(), run.scenario.seed.value(),
                       to_text(run.options.timing));
}

std::string endpoints_line(const ports::Relay& relay)
{
    const auto in_words = [](const ports::Relay::Side& side) {
        const auto& address = side.filter.address();
        return address ? address->to_text() : std::string{"not known yet"};
    };
    return fmt::format("a is {}, b is {}", in_words(relay.a()), in_words(relay.b()));
}

nlohmann::ordered_json statistics_of(const Run& run)
{
    const Options& options = run.options;
    const ports::Relay::Side& a = run.relay.a();
    const ports::Relay::Side& b = run.relay.b();
    // Clients may ask for them many times a second, and the relay answers.
    constexpr std::size_t while_it_runs = 20;
    const ChangeLog& log = run.path.changes();
    Json changes = changes_json(log, run.is_over ? ChangeLog::entries_max : while_it_runs);
    const auto omitted = log.omitted() + (log.entries().size() - changes.size());
    std::vector<std::string> reasons;
    for (const auto& [way, side] : {std::pair{"up", &a}, std::pair{"down", &b}}) {
        for (const std::string& reason : reasons_against(direction_of(*side), options.budget)) {
            reasons.push_back(fmt::format("{}: {}", way, reason));
        }
    }
    Json json{
        {"program", "hapnet-emulator"},
        {"version", base::version()},
        {"commit", base::commit()},
        {"compiler", base::compiler()},
        {"seed", run.scenario.seed.value()},
        {"timing", to_text(options.timing)},
        {"budget_us", json_in_us(options.budget)},
        {"duration_s", base::to_seconds(run.elapsed)},
        {"real_time",
         {{"fifo", run.real_time.fifo}, {"locked_memory", run.real_time.locked_memory}}},
        {"listen_a", a.socket.local().to_text()},
        {"listen_b", b.socket.local().to_text()},
        {"a", address_of(a)},
        {"b", address_of(b)},
        {"strangers", a.strangers + b.strangers},
        {"overflowed", a.socket.overflowed() + b.socket.overflowed()},
        {"generation", run.path.director().generation()},
        {"configuration_at_start", configuration_json(run.scenario.profile.path)},
        {"configuration_at_end", configuration_json(run.path.director().path())},
        {"changes", std::move(changes)},
        {"changes_omitted", omitted},
        {"profile", to_text(run.scenario.profile)},
        {"fates", or_null(options.fates)},
        {"replay", or_null(options.replay)},
        {"capture", or_null(options.capture)},
        {"fates_lost", run.recorder.fates_lost()},
        {"capture_lost", run.recorder.capture_lost()},
        {"valid", reasons.empty()},
        {"invalid_because", reasons},
        {"up", direction_json(a, run)},
        {"down", direction_json(b, run)},
    };
    if (!run.scenario.checks.empty()) json["checks"] = judged(run.scenario.checks, json);
    return json;
}

std::string summary(const Run& run)
{
    return fmt::format("{:.1f} s, seed {}\n", base::to_seconds(run.elapsed),
                       run.scenario.seed.value()) +
           in_words("up   (A to B)", direction_of(run.relay.a()), run.options.budget) +
           in_words("down (B to A)", direction_of(run.relay.b()), run.options.budget) +
           incomplete(run.recorder);
}

std::string status_line(const Run& run)
{
    return fmt::format("{:.0f} s | {} | {}", base::to_seconds(run.elapsed),
                       in_short("up", direction_of(run.relay.a())),
                       in_short("down", direction_of(run.relay.b())));
}

} // namespace hapnet::emulator
