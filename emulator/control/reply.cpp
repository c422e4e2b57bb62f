// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/control/reply.hpp"

#include "emulator/control/change.hpp"
#include "emulator/control/frames.hpp"
#include "emulator/control/moment.hpp"
#include "emulator/control/run_statistics.hpp"
#include "emulator/control/settings.hpp"
#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/flows.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/text.hpp"
#include "proto/control/core/reply.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace hapnet::emulator {

namespace {

using control::line_of;
using control::refusal;
using Json = nlohmann::ordered_json;

Json settings_json(const Director::Override& one)
{
    Json json = Json::object();
    for (const auto& [key, value] : texts_of(Direction::up, one.up)) json[key] = value;
    for (const auto& [key, value] : texts_of(Direction::down, one.down)) json[key] = value;
    return json;
}

Json seconds(std::optional<base::Duration> duration)
{
    return duration ? Json(base::to_seconds(*duration)) : Json(nullptr);
}

/// Returns a function that opens the files that a request names: those in the request, or else
/// those in the folder, whose contents must not be shown to the client.
OpenFile files_for(const SentFiles& sent, const Emulation& emulation)
{
    if (sent) {
        return [&sent](const std::string& name) -> base::Result<std::string> {
            const auto found = sent->find(name);
            if (found != sent->end()) return found->second;
            return base::fail(fmt::format("the request does not bring the file '{}'", name));
        };
    }
    if (emulation.folder) return emulation.folder.unquoted();
    return [](const std::string& name) -> base::Result<std::string> {
        return base::fail(
            fmt::format("the file '{}' was not sent, and there is no folder to read it from: "
                        "hapnet-ctl sends it, and --files DIR at the start names a folder",
                        name));
    };
}

/// Reads the profile in the request, or the preset that it names. Adds to `warnings` a sentence for
/// each part of a netem sentence that is done differently here.
base::Result<Profile> parsed(const ProfileText& text, const SentFiles& files,
                             const Emulation& emulation, std::vector<std::string>& warnings)
{
    if (text.netem) {
        if (!emulation.netem) return base::fail("sentences of netem are not understood here");
        return emulation.netem(*text.netem).map([&](TranslatedProfile netem) {
            warnings = std::move(netem.warnings);
            return std::move(netem.profile);
        });
    }
    const auto read = [&](const std::string& toml, const std::string& name) {
        return parse_profile(toml, name, files_for(files, emulation), emulation.paths.names());
    };
    if (!text.preset) return read(text.toml, text.file);
    return emulation.preset(*text.preset).and_then([&](const std::string& toml) {
        return read(toml, *text.preset);
    });
}

/// Returns the current conditions, without those that change nothing: {"up.delay":"160ms", ...}.
Json conditions_json(const Moment& moment)
{
    Json json = Json::object();
    for (const Decider& one : moment.deciders) {
        if (!one.is_there) continue;
        for (const Direction direction : {Direction::up, Direction::down}) {
            const Path& path = one.director.path();
            const Patch patch = to_patch(direction == Direction::up ? path.up : path.down);
            for (const auto& [key, value] : texts_of(direction, patch, one.name)) json[key] = value;
        }
    }
    return json;
}

/// Returns the values of the only path, or of each path by its name. Each has the values of its
/// flows.
Json effective_at(const std::vector<NextNumbers>& all)
{
    Json json = Json::object();
    for (const NextNumbers& next : all) {
        const auto [path, flow] = parts_of(next.name);
        Json& of_path = path.empty() ? json : json[std::string{path}];
        Json& numbers = flow.empty() ? of_path : of_path["flows"][std::string{flow}];
        numbers["up"] = next.up;
        numbers["down"] = next.down;
    }
    return json;
}

/// Applies a command and returns the answer, which says from when on the new conditions are in
/// effect.
base::Result<Json> effect_of(const Paths::CommandFor& command,
                             std::span<const std::string> mentioned, Emulation& emulation,
                             base::TimePoint now)
{
    return change(emulation, command, mentioned, now).map([](const Effect& effect) {
        return Json{{"ok", true},
                    {"generation", effect.generation},
                    {"changed", effect.has_changed},
                    {"elapsed_s", base::to_seconds(effect.elapsed)},
                    {"effective_at_ns", effect.at.time_since_epoch().count()},
                    {"effective_at", effective_at(effect.next)}};
    });
}

std::string answer_of(const base::Result<Json>& effect)
{
    return effect ? line_of(*effect) : refusal(effect.error().message);
}

/// Returns the settings made by hand on several paths: one entry for all that end at one time.
Json live_of_several(const std::vector<Decider>& deciders, base::TimePoint now)
{
    std::map<std::optional<base::TimePoint>, std::vector<PathPatch>> by_end;
    for (const Decider& decider : deciders) {
        for (const auto& one : decider.director.overrides()) {
            auto& patches = by_end[one->until];
            const auto known = std::ranges::find(patches, decider.name, &PathPatch::path);
            PathPatch& patch = known != patches.end()
                                   ? *known
                                   : patches.emplace_back(PathPatch{decider.name, {}, {}});
            patch.up = merged(std::move(patch.up), one->up);
            patch.down = merged(std::move(patch.down), one->down);
        }
    }
    Json live = Json::array();
    for (auto& [end, patches] : by_end) {
        JoinedPatch all;
        if (patches.size() == deciders.size()) {
            all = joined(std::move(patches));
        } else {
            all.paths = std::move(patches);
        }
        Json settings = Json::object();
        const auto add = [&](std::string_view path, const Patch& up, const Patch& down) {
            for (const auto& [key, value] : texts_of(Direction::up, up, path)) {
                settings[key] = value;
            }
            for (const auto& [key, value] : texts_of(Direction::down, down, path)) {
                settings[key] = value;
            }
        };
        add("", all.up, all.down);
        for (const PathPatch& own : all.paths) add(own.path, own.up, own.down);
        live.push_back({{"settings", std::move(settings)},
                        {"remaining_s", seconds(end ? std::optional{*end - now} : std::nullopt)}});
    }
    return live;
}

Json live_of(const Director& director)
{
    Json live = Json::array();
    for (const auto& one : director.overrides()) {
        std::optional<base::Duration> left;
        if (one->until) left = *one->until - director.now();
        live.push_back({{"settings", settings_json(*one)}, {"remaining_s", seconds(left)}});
    }
    return live;
}

/// Returns the changes that are still to come. In a run with clients, they are those of clients
/// without settings of their own.
Profile remaining_of(const Emulation& emulation, const std::vector<Decider>& deciders)
{
    const bool has_clients = emulation.paths.names().clients;
    std::vector<NamedProfile> profiles;
    for (const Decider& one : deciders) {
        const bool is_common = one.name == common_name(one.name) && !one.is_there;
        if (has_clients && !is_common) continue;
        profiles.push_back({one.name, one.director.remaining()});
    }
    if (profiles.size() == 1 && profiles.front().path.empty()) return profiles.front().profile;
    return joined(profiles, emulation.paths.flows());
}

} // namespace

std::string reply_to(const ShowRequest& /*request*/, Emulation& emulation, base::TimePoint now)
{
    const Moment moment = moment_of(emulation, now);
    const auto& deciders = moment.deciders;
    const Director& director = deciders.back().director;
    std::optional<base::Duration> next;
    if (moment.next_change) next = *moment.next_change - director.now();
    const bool is_only = deciders.size() == 1;
    return line_of(Json{{"ok", true},
                        {"generation", moment.generation},
                        {"elapsed_s", base::to_seconds(moment.elapsed)},
                        {"timeline",
                         {{"position_s", base::to_seconds(director.position())},
                          {"changes", director.script().profile().timeline.size()},
                          {"next_change_in_s", seconds(next)}}},
                        {"conditions", conditions_json(moment)},
                        {"held_s", seconds(emulation.held)},
                        {"live", is_only && deciders.front().name.empty()
                                     ? live_of(director)
                                     : live_of_several(deciders, director.now())},
                        {"profile", to_text(remaining_of(emulation, deciders))}});
}

std::string reply_to(const SetRequest& request, Emulation& emulation, base::TimePoint now)
{
    const auto settings =
        settings_of(request, files_for(request.files, emulation), emulation.paths.names());
    if (!settings) return refusal(settings.error().message);
    std::vector<std::string> mentioned;
    for (const Setting& setting : *settings) {
        if (!setting.path.empty()) mentioned.push_back(setting.path);
    }
    const auto command = [&](std::string_view name, const Path& path) {
        return set_of(*settings, request.lasting, name, path).map([](Set set) {
            return Command{std::move(set)};
        });
    };
    return answer_of(effect_of(command, mentioned, emulation, now));
}

std::string reply_to(const ApplyRequest& request, Emulation& emulation, base::TimePoint now)
{
    std::vector<std::string> warnings;
    const auto profile = parsed(request.profile, request.files, emulation, warnings);
    if (!profile) return refusal(profile.error().message);
    if (const auto same = ensure_same_flows(*profile, emulation.paths.flows()); !same) {
        return refusal(same.error().message);
    }
    const Scripts scripts{*profile};
    auto effect = effect_of(scripts.command(), scripts.mentioned(), emulation, now);
    if (effect && !warnings.empty()) (*effect)["warnings"] = std::move(warnings);
    return answer_of(effect);
}

std::string reply_to(const DiffRequest& request, Emulation& emulation, base::TimePoint now)
{
    std::vector<std::string> warnings;
    const auto profile = parsed(request.profile, request.files, emulation, warnings);
    if (!profile) return refusal(profile.error().message);
    if (const auto same = ensure_same_flows(*profile, emulation.paths.flows()); !same) {
        return refusal(same.error().message);
    }
    const Moment moment = moment_of(emulation, now);
    Json changes = Json::array();
    bool is_other_timeline = false;
    for (const Decider& one : moment.deciders) {
        const Profile own = profile_of(*profile, one.name);
        for (const auto& [key, from, to] : differences(one.director.path(), own.path, one.name)) {
            changes.push_back({{"key", key}, {"from", from}, {"to", to}});
        }
        is_other_timeline = is_other_timeline || one.director.remaining().timeline != own.timeline;
    }
    const auto steps = moment.deciders.back().director.remaining().timeline.size();
    return line_of(Json{{"ok", true},
                        {"changes", std::move(changes)},
                        {"timeline", {{"from", steps}, {"to", profile->timeline.size()}}},
                        {"is_other_timeline", is_other_timeline}});
}

std::string reply_to(const ResetRequest& /*request*/, Emulation& emulation, base::TimePoint now)
{
    return answer_of(
        effect_of([](std::string_view, const Path&) -> base::Result<Command> { return Reset{}; },
                  {}, emulation, now));
}

std::string reply_to(const StopRequest& /*request*/, const Emulation& emulation)
{
    emulation.work([&] {
        emulation.stop();
        return true;
    });
    return line_of(Json{{"ok", true}, {"stopping", true}, {"program", "hapnet-emulator"}});
}

std::string reply_to(const KeepRequest& request, const Emulation& emulation, base::TimePoint now)
{
    const base::TimePoint from = now - request.last.value_or(*emulation.held);
    return control::keep_reply(emulation.keep(request.name, from), from, now);
}

nlohmann::ordered_json statistics_of(Emulation& emulation)
{
    auto json = emulation.statistics(emulation.work);
    emulation.work([&] {
        json["generation"] = emulation.paths.generation();
        json["elapsed_s"] = base::to_seconds(emulation.paths.elapsed());
        return true;
    });
    return json;
}

output::Metrics metrics_of(nlohmann::ordered_json statistics)
{
    // Removes the entries of links and flows, because adding them to the sums would count them
    // twice.
    const auto leave_parts_of = [](nlohmann::ordered_json& whole, const char* parts) {
        if (!whole.contains(parts)) return false;
        whole.erase("up");
        whole.erase("down");
        return true;
    };
    leave_parts_of(statistics, "flows");
    if (leave_parts_of(statistics, "links")) {
        statistics.erase("flows");
        for (auto& link : statistics["links"]) leave_parts_of(link, "flows");
    }
    output::Metrics metrics;
    metrics.add(base::field_table<RunStatistics>(), statistics);
    return metrics;
}

control::Answer answer_to(std::string_view line, Emulation& emulation, base::TimePoint now)
{
    const auto request = parse_request(line, emulation.held);
    if (!request) return refusal(request.error().message);
    return std::visit(
        [&]<typename One>(const One& one) -> control::Answer {
            if constexpr (std::is_same_v<One, WaitRequest> || std::is_same_v<One, WatchRequest>) {
                return one;
            } else if constexpr (std::is_same_v<One, StatsRequest>) {
                return control::statistics_reply(statistics_of(emulation));
            } else if constexpr (std::is_same_v<One, MetricsRequest>) {
                return line_of(
                    {{"ok", true}, {"metrics", metrics_of(statistics_of(emulation)).json()}});
            } else if constexpr (std::is_same_v<One, StopRequest>) {
                return reply_to(one, emulation);
            } else {
                return reply_to(one, emulation, now);
            }
        },
        *request);
}

control::Subject subject_of(Emulation& emulation)
{
    auto frames = std::make_shared<Frames>();
    return {[&emulation](std::string_view line, base::TimePoint now) {
                return answer_to(line, emulation, now);
            },
            [&emulation] { return statistics_of(emulation); },
            [&emulation, frames] { return frames->watch(emulation.paths, emulation.work); }};
}

} // namespace hapnet::emulator
