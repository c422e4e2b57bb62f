// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/control/reply.hpp"

#include "emulator/control/settings.hpp"
#include "emulator/core/profile/text.hpp"
#include "proto/base/ensure.hpp"
#include "proto/control/core/reply.hpp"

#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>

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

base::Result<Profile> profile_of(const ProfileText& text, const Emulation& emulation)
{
    if (text.preset) {
        return emulation.preset(*text.preset).and_then([&](const std::string& toml) {
            return parse_profile(toml, *text.preset, files_beside("", emulation));
        });
    }
    return parse_profile(text.toml, text.file, files_beside(text.file, emulation));
}

/// The answer to a command: from when on the conditions hold.
std::string effect_of(const Command& command, Emulation& emulation, base::TimePoint now)
{
    EmulatedPath& path = emulation.path;
    const auto generation = path.director().generation();
    if (const auto done = path.apply(command, now); !done) return refusal(done.error().message);
    const auto next = [&](Direction direction) {
        return path.link(direction).statistics().received;
    };
    return line_of(
        Json{{"ok", true},
             {"generation", path.director().generation()},
             {"changed", path.director().generation() != generation},
             {"elapsed_s", base::to_seconds(path.director().elapsed())},
             {"effective_at_ns", now.time_since_epoch().count()},
             {"effective_at", {{"up", next(Direction::up)}, {"down", next(Direction::down)}}}});
}

} // namespace

std::string reply_to(const ShowRequest& /*request*/, const Emulation& emulation)
{
    const Director& director = emulation.path.director();
    const base::TimePoint now = director.now();
    Json live = Json::array();
    for (const Director::Override& one : director.overrides()) {
        std::optional<base::Duration> left;
        if (one.until) left = *one.until - now;
        live.push_back({{"settings", settings_json(one)}, {"remaining_s", seconds(left)}});
    }
    std::optional<base::Duration> next;
    if (const auto change = director.next_change()) next = *change - now;
    return line_of(Json{{"ok", true},
                        {"generation", director.generation()},
                        {"elapsed_s", base::to_seconds(director.elapsed())},
                        {"timeline",
                         {{"position_s", base::to_seconds(director.position())},
                          {"changes", director.profile().timeline.size()},
                          {"next_change_in_s", seconds(next)}}},
                        {"live", std::move(live)},
                        {"profile", to_text(director.remaining())}});
}

std::string reply_to(const SetRequest& request, Emulation& emulation, base::TimePoint now)
{
    auto set = set_of(request, emulation.path.director().path(), files_beside("", emulation));
    return set ? effect_of(*std::move(set), emulation, now) : refusal(set.error().message);
}

std::string reply_to(const ApplyRequest& request, Emulation& emulation, base::TimePoint now)
{
    auto profile = profile_of(request.profile, emulation);
    if (!profile) return refusal(profile.error().message);
    return effect_of(Apply{*std::move(profile)}, emulation, now);
}

std::string reply_to(const DiffRequest& request, const Emulation& emulation)
{
    const auto profile = profile_of(request.profile, emulation);
    if (!profile) return refusal(profile.error().message);
    const Director& director = emulation.path.director();
    Json changes = Json::array();
    for (const auto& [key, from, to] : differences(director.path(), profile->path)) {
        changes.push_back({{"key", key}, {"from", from}, {"to", to}});
    }
    const auto steps = director.remaining().timeline.size();
    return line_of(Json{{"ok", true},
                        {"changes", std::move(changes)},
                        {"timeline", {{"from", steps}, {"to", profile->timeline.size()}}},
                        {"is_other_timeline", director.remaining().timeline != profile->timeline}});
}

std::string reply_to(const ResetRequest& /*request*/, Emulation& emulation, base::TimePoint now)
{
    return effect_of(Reset{}, emulation, now);
}

std::string reply_to(const StopRequest& /*request*/, const Emulation& emulation)
{
    emulation.stop();
    return line_of(Json{{"ok", true}, {"stopping", true}, {"program", "hapnet-emulator"}});
}

nlohmann::ordered_json statistics_of(const Emulation& emulation)
{
    auto json = Json::parse(emulation.statistics_json(), nullptr,
                            /*allow_exceptions*/ false);
    base::ensure(json.is_object());
    json["generation"] = emulation.path.director().generation();
    json["elapsed_s"] = base::to_seconds(emulation.path.director().elapsed());
    return json;
}

control::Answer answer_to(std::string_view line, Emulation& emulation, base::TimePoint now)
{
    const auto request = parse_request(line);
    if (!request) return refusal(request.error().message);
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
    if (const auto* wait = std::get_if<WaitRequest>(&*request)) return *wait;
    if (const auto* watch = std::get_if<WatchRequest>(&*request)) return *watch;
    return control::statistics_reply(statistics_of(emulation));
}

control::Subject subject_of(Emulation& emulation)
{
    return {[&emulation](std::string_view line, base::TimePoint now) {
                return answer_to(line, emulation, now);
            },
            [&emulation] { return statistics_of(emulation); }};
}

} // namespace hapnet::emulator
