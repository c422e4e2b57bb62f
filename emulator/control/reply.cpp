// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/control/reply.hpp"

#include "emulator/control/frames.hpp"
#include "emulator/control/settings.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/text.hpp"
#include "proto/base/ensure.hpp"
#include "proto/control/core/reply.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>
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

/// Opens the files that a text names: they lie beside the file that it comes from.
OpenFile files_beside(const std::string& file, const Emulation& emulation)
{
    return [&emulation, file](const std::string& name) { return emulation.open(name, file); };
}

/// `warnings`: what of it cannot be done.
base::Result<Profile> parsed(const ProfileText& text, const Emulation& emulation,
                             std::vector<std::string>& warnings)
{
    if (text.netem) {
        if (!emulation.netem) return base::fail("sentences of netem are not understood here");
        return emulation.netem(*text.netem).map([&](TranslatedProfile netem) {
            warnings = std::move(netem.warnings);
            return std::move(netem.profile);
        });
    }
    const auto read = [&](const std::string& toml, const std::string& name,
                          const std::string& beside) {
        return parse_profile(toml, name, files_beside(beside, emulation), emulation.paths.names());
    };
    if (!text.preset) return read(text.toml, text.file, text.file);
    return emulation.preset(*text.preset).and_then([&](const std::string& toml) {
        return read(toml, *text.preset, "");
    });
}

/// The numbers of the next datagrams.
Json next_numbers(const EmulatedPath& path)
{
    const auto next = [&](Direction direction) {
        return path.link(direction).statistics().received;
    };
    return {{"up", next(Direction::up)}, {"down", next(Direction::down)}};
}

/// What holds now, without what does nothing: {"up.delay":"160ms", ...}.
Json conditions_json(const AllPaths& paths)
{
    Json json = Json::object();
    for (const Paths::Named* one : paths.all()) {
        for (const Direction direction : {Direction::up, Direction::down}) {
            const Patch patch = to_patch(one->path->link(direction).conditions());
            for (const auto& [key, value] : texts_of(direction, patch, one->name))
                json[key] = value;
        }
    }
    return json;
}

/// Of the only path, or of each by its name.
Json effective_at(const AllPaths& paths)
{
    Json json = Json::object();
    for (const Paths::Named* one : paths.all()) {
        if (one->name.empty()) return next_numbers(*one->path);
        json[one->name] = next_numbers(*one->path);
    }
    return json;
}

/// The answer to a command: from when on the conditions hold.
base::Result<Json> effect_of(const Paths::CommandFor& command,
                             std::span<const std::string> mentioned, Emulation& emulation,
                             base::TimePoint now)
{
    AllPaths& paths = emulation.paths;
    const auto generation = paths.generation();
    if (const auto done = paths.apply(command, mentioned, now); !done) {
        return tl::unexpected{done.error()};
    }
    return Json{{"ok", true},
                {"generation", paths.generation()},
                {"changed", paths.generation() != generation},
                {"elapsed_s", base::to_seconds(paths.elapsed())},
                {"effective_at_ns", now.time_since_epoch().count()},
                {"effective_at", effective_at(paths)}};
}

std::string answer_of(const base::Result<Json>& effect)
{
    return effect ? line_of(*effect) : refusal(effect.error().message);
}

using Deciders = std::vector<Paths::Decider>;

/// What is set by hand on several paths: one entry for all that ends at the same time.
Json live_of_several(const Deciders& deciders, base::TimePoint now)
{
    std::map<std::optional<base::TimePoint>, std::vector<PathPatch>> by_end;
    for (const auto& [name, director] : deciders) {
        for (const Director::Override& one : director->overrides()) {
            auto& patches = by_end[one.until];
            const auto known = std::ranges::find(patches, name, &PathPatch::path);
            PathPatch& patch = known != patches.end()
                                   ? *known
                                   : patches.emplace_back(PathPatch{std::string{name}, {}, {}});
            patch.up = merged(std::move(patch.up), one.up);
            patch.down = merged(std::move(patch.down), one.down);
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
    for (const Director::Override& one : director.overrides()) {
        std::optional<base::Duration> left;
        if (one.until) left = *one.until - director.now();
        live.push_back({{"settings", settings_json(one)}, {"remaining_s", seconds(left)}});
    }
    return live;
}

/// What is still to come; with clients, of those that have nothing of their own.
Profile remaining_of(const Emulation& emulation, const Deciders& deciders)
{
    const bool has_clients = emulation.paths.names().clients;
    if (has_clients || deciders.size() == 1) {
        Profile remaining = deciders.back().director->remaining();
        if (deciders.back().name.empty()) return remaining;
    }
    std::vector<NamedProfile> profiles;
    for (const auto& [name, director] : deciders) {
        profiles.push_back({std::string{name}, director->remaining()});
    }
    return joined(profiles);
}

} // namespace

std::string reply_to(const ShowRequest& /*request*/, const Emulation& emulation)
{
    const auto deciders = emulation.paths.deciders();
    const Director& director = *deciders.back().director;
    const base::TimePoint now = director.now();
    std::optional<base::Duration> next;
    if (const auto change = emulation.paths.next_change()) next = *change - now;
    const bool is_only = deciders.size() == 1;
    return line_of(
        Json{{"ok", true},
             {"generation", emulation.paths.generation()},
             {"elapsed_s", base::to_seconds(emulation.paths.elapsed())},
             {"timeline",
              {{"position_s", base::to_seconds(director.position())},
               {"changes", director.profile().timeline.size()},
               {"next_change_in_s", seconds(next)}}},
             {"conditions", conditions_json(emulation.paths)},
             {"held_s", seconds(emulation.held)},
             {"live", is_only && deciders.front().name.empty() ? live_of(director)
                                                               : live_of_several(deciders, now)},
             {"profile", to_text(remaining_of(emulation, deciders))}});
}

std::string reply_to(const SetRequest& request, Emulation& emulation, base::TimePoint now)
{
    const auto settings =
        settings_of(request, files_beside("", emulation), emulation.paths.names());
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
    const auto profile = parsed(request.profile, emulation, warnings);
    if (!profile) return refusal(profile.error().message);
    const auto command = [&](std::string_view name, const Path& /*path*/) -> base::Result<Command> {
        return Apply{profile_of(*profile, name)};
    };
    auto effect = effect_of(command, paths_in(*profile), emulation, now);
    if (effect && !warnings.empty()) (*effect)["warnings"] = std::move(warnings);
    return answer_of(effect);
}

std::string reply_to(const DiffRequest& request, const Emulation& emulation)
{
    std::vector<std::string> warnings;
    const auto profile = parsed(request.profile, emulation, warnings);
    if (!profile) return refusal(profile.error().message);
    const auto deciders = emulation.paths.deciders();
    Json changes = Json::array();
    bool is_other_timeline = false;
    for (const auto& [name, director] : deciders) {
        const Profile own = profile_of(*profile, name);
        for (const auto& [key, from, to] : differences(director->path(), own.path, name)) {
            changes.push_back({{"key", key}, {"from", from}, {"to", to}});
        }
        is_other_timeline = is_other_timeline || director->remaining().timeline != own.timeline;
    }
    const auto steps = deciders.back().director->remaining().timeline.size();
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
    emulation.stop();
    return line_of(Json{{"ok", true}, {"stopping", true}, {"program", "hapnet-emulator"}});
}

std::string reply_to(const KeepRequest& request, const Emulation& emulation, base::TimePoint now)
{
    const base::TimePoint from = now - request.last.value_or(*emulation.held);
    return control::keep_reply(emulation.keep(request.name, from), from, now);
}

nlohmann::ordered_json statistics_of(const Emulation& emulation)
{
    auto json = Json::parse(emulation.statistics_json(), nullptr,
                            /*allow_exceptions*/ false);
    base::ensure(json.is_object());
    json["generation"] = emulation.paths.generation();
    json["elapsed_s"] = base::to_seconds(emulation.paths.elapsed());
    return json;
}

control::Answer answer_to(std::string_view line, Emulation& emulation, base::TimePoint now)
{
    const auto request = parse_request(line, emulation.held);
    if (!request) return refusal(request.error().message);
    emulation.paths.catch_up(now);
    if (const auto* one = std::get_if<ShowRequest>(&*request)) return reply_to(*one, emulation);
    if (const auto* set = std::get_if<SetRequest>(&*request)) {
        return reply_to(*set, emulation, now);
    }
    if (const auto* apply = std::get_if<ApplyRequest>(&*request)) {
        return reply_to(*apply, emulation, now);
    }
    if (const auto* diff = std::get_if<DiffRequest>(&*request)) return reply_to(*diff, emulation);
    if (const auto* reset = std::get_if<ResetRequest>(&*request)) {
        return reply_to(*reset, emulation, now);
    }
    if (const auto* stop = std::get_if<StopRequest>(&*request)) return reply_to(*stop, emulation);
    if (const auto* keep = std::get_if<KeepRequest>(&*request)) {
        return reply_to(*keep, emulation, now);
    }
    if (const auto* wait = std::get_if<WaitRequest>(&*request)) return *wait;
    if (const auto* watch = std::get_if<WatchRequest>(&*request)) return *watch;
    return control::statistics_reply(statistics_of(emulation));
}

control::Subject subject_of(Emulation& emulation)
{
    auto frames = std::make_shared<Frames>();
    return {[&emulation](std::string_view line, base::TimePoint now) {
                return answer_to(line, emulation, now);
            },
            [&emulation] { return statistics_of(emulation); },
            [&emulation, frames] { return frames->watch(emulation.paths); }};
}

} // namespace hapnet::emulator
