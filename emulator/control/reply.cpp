// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/control/reply.hpp"

#include "emulator/control/settings.hpp"
#include "emulator/core/profile/text.hpp"
#include "proto/base/ensure.hpp"

#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t error_bytes_max = 2000;

/// On one line; what is no UTF-8 is replaced, so that every text can be printed.
std::string line_of(const Json& json)
{
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

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
    return parse_profile(text.toml, text.file, files_beside(text.file, emulation));
}

/// The answer to a command: from when on the conditions hold.
std::string effect_of(const Command& command, Emulation& emulation, base::TimePoint now)
{
    if (const auto done = carry_out(command, emulation, now); !done) {
        return refusal(done.error().message);
    }
    const NextNumbers next = emulation.next_numbers();
    return line_of(Json{{"ok", true},
                        {"generation", emulation.director.generation()},
                        {"elapsed_s", base::to_seconds(emulation.director.elapsed())},
                        {"effective_at_ns", now.time_since_epoch().count()},
                        {"effective_at", {{"up", next.up}, {"down", next.down}}}});
}

} // namespace

std::string refusal(std::string_view error)
{
    std::string text{error.substr(0, error_bytes_max)};
    if (text.size() < error.size()) text += "...";
    return line_of(Json{{"ok", false}, {"error", text}});
}

std::string busy_refusal()
{
    return line_of(Json{{"ok", false},
                        {"busy", true},
                        {"error", "too many clients are connected; try again when one has gone"}});
}

base::Result<void> carry_out(const Command& command, Emulation& emulation, base::TimePoint now)
{
    Director& director = emulation.director;
    const auto generation = director.generation();
    auto done = director.apply(command, now);
    if (director.generation() != generation) emulation.enact(director.path(), now);
    return done;
}

std::string reply_to(const ShowRequest& /*request*/, const Emulation& emulation)
{
    const Director& director = emulation.director;
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
    auto set = set_of(request, emulation.director.path(), files_beside("", emulation));
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
    const Director& director = emulation.director;
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

nlohmann::ordered_json statistics_of(const Emulation& emulation)
{
    auto json = Json::parse(emulation.statistics_json(), nullptr,
                            /*allow_exceptions*/ false);
    base::ensure(json.is_object());
    json["generation"] = emulation.director.generation();
    json["elapsed_s"] = base::to_seconds(emulation.director.elapsed());
    return json;
}

std::string statistics_reply(const Emulation& emulation)
{
    Json reply{{"ok", true}};
    reply.update(statistics_of(emulation));
    return line_of(reply);
}

std::string wait_reply(const Condition& until, bool is_met, const Emulation& emulation)
{
    return line_of(Json{{"ok", true},
                        {"until", to_text(until)},
                        {"met", is_met},
                        {"generation", emulation.director.generation()},
                        {"elapsed_s", base::to_seconds(emulation.director.elapsed())}});
}

} // namespace hapnet::emulator
