// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/live/control.hpp"

#include "peer/control/answer.hpp"
#include "peer/control/scene_report.hpp"
#include "proto/base/fields.hpp"
#include "proto/control/core/reply.hpp"
#include "proto/control/core/request.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>
#include <variant>

namespace hapnet::lab::live {

namespace {

using Json = nlohmann::ordered_json;
using control::Members;

Json factor_json(const Pace& pace) { return pace.factor() ? Json(*pace.factor()) : Json("max"); }

template <typename Played>
Json pace_json(const Controlled<Played>& controlled)
{
    const Played& session = controlled.session;
    const char* playing = controlled.pace.plays() ? "playing" : "paused";
    return {{"state", session.is_over() ? "ended" : playing},
            {"factor", factor_json(controlled.pace)},
            {"at_s", base::to_seconds(session.at())},
            {"length_s", base::to_seconds(session.length())},
            {"digest", fmt::format("{:016x}", session.digest())},
            {"steps", session.steps()},
            {"read_only", Played::is_read_only}};
}

/// Reads a number of seconds of at least `least`. Otherwise returns 0 and notes the fault.
double seconds_in(Members& members, const char* key, double least)
{
    constexpr double most = 3600.0;
    const Json* value = members.find(key);
    if (value != nullptr && value->is_number()) {
        const auto seconds = value->get<double>();
        if (seconds >= least && seconds <= most) return seconds;
    }
    members.fail(fmt::format("\"{}\" must be a number of seconds from {} to {}", key, least, most));
    return 0.0;
}

/// Reads the factor of the pace; nullopt: as fast as possible, or a fault was noted.
std::optional<double> factor_in(Members& members)
{
    const Json* value = members.find("factor");
    if (value != nullptr && *value == "max") return std::nullopt;
    if (value != nullptr && value->is_number()) {
        const auto factor = value->get<double>();
        if (factor >= Pace::factor_min && factor <= Pace::factor_max) return factor;
    }
    members.fail(fmt::format("\"factor\" must be a number from {} to {}, or \"max\"",
                             Pace::factor_min, Pace::factor_max));
    return std::nullopt;
}

/// Carries out a request about the pace if it is valid. Returns the further members of the reply.
template <typename Played>
base::Result<Json> pace_done(Members& members, const Controlled<Played>& controlled)
{
    auto& session = controlled.session;
    auto& pace = controlled.pace;
    const auto& save = controlled.save;
    const auto what = members.text("do");
    std::function<base::Result<Json>()> act;
    if (what == "play") {
        act = [&] {
            if (session.is_over()) session.seek(base::Duration{0});
            pace.play();
            return Json::object();
        };
    } else if (what == "pause") {
        act = [&] {
            pace.pause();
            return Json::object();
        };
    } else if (what == "step") {
        const auto by = base::from_seconds(seconds_in(members, "by_s", 0.001));
        act = [&, by] {
            pace.pause();
            session.play_on(by);
            return Json::object();
        };
    } else if (what == "seek") {
        const auto to = base::from_seconds(seconds_in(members, "to_s", 0.0));
        act = [&, to] {
            session.seek(to);
            return Json::object();
        };
    } else if (what == "factor") {
        const auto factor = factor_in(members);
        act = [&, factor] {
            pace.set_factor(factor);
            return Json::object();
        };
    } else if (what == "save") {
        act = [&]() -> base::Result<Json> {
            auto saved = session.as_experiment();
            if (!saved) return tl::unexpected{saved.error()};
            const auto file = save(*std::move(saved));
            if (!file) return tl::unexpected{file.error()};
            return Json{{"file", *file}};
        };
    } else {
        members.fail("\"do\" must be one of play, pause, step, seek, factor, save");
    }
    const auto whole = members.finish(true);
    if (!whole) return tl::unexpected{whole.error()};
    return act();
}

template <typename Played>
std::string pace_reply(Members& members, const Controlled<Played>& controlled)
{
    const auto done = pace_done(members, controlled);
    if (!done) return control::refusal(done.error().message);
    Json reply{{"ok", true}, {"pace", pace_json(controlled)}};
    reply.update(*done);
    return control::line_of(reply);
}

/// Adds the program, the peers and the pace to an emulator's reply about itself.
template <typename Played>
std::string shown(const std::string& reply, const Controlled<Played>& controlled)
{
    auto json = Json::parse(reply, nullptr, /*allow_exceptions*/ false);
    if (!json.is_object()) return reply;
    json["program"] = "hapnet-lab";
    json["peers"] = controlled.session.peers();
    json["pace"] = pace_json(controlled);
    return control::line_of(json);
}

template <typename Played>
std::string stopped(Members& members, const Controlled<Played>& controlled)
{
    const auto whole = members.finish(true);
    if (!whole) return control::refusal(whole.error().message);
    controlled.stop();
    return control::line_of(Json{{"ok", true}, {"stopping", true}, {"program", "hapnet-lab"}});
}

template <typename Played>
control::Answer answer_to(std::string_view line, const Controlled<Played>& controlled)
{
    const auto json = control::parse_object(line);
    if (!json) return control::refusal(json.error().message);
    Members members{*json};
    const std::string command = members.text("command");
    if (command == "pace") return pace_reply(members, controlled);
    if (command == "stop") return stopped(members, controlled);
    auto answer = controlled.session.answer(line);
    const auto* reply = std::get_if<std::string>(&answer);
    if (command == "show" && reply != nullptr) return shown(*reply, controlled);
    return answer;
}

} // namespace

template <typename Played>
control::Subject subject_of(const Controlled<Played>& controlled)
{
    return {[controlled](std::string_view line, base::TimePoint) {
                return answer_to(line, controlled);
            },
            [controlled] { return controlled.session.statistics(); },
            [controlled] { return controlled.session.watch(); }};
}

template <typename Played>
control::Subject peer_subject(const Controlled<Played>& controlled, std::size_t seat)
{
    Played& session = controlled.session;
    decltype(peer::PeerControl::hand) hand;
    if constexpr (!Played::is_read_only) {
        if (seat == 0 && session.has_page_hand())
            hand = [&session](const auto& wish) { session.hand(wish); };
    }
    return peer::subject_of(
        {.show = [&session, seat] { return session.show_peer(seat); },
         .statistics = [&session, seat] { return session.peer_statistics(seat); },
         .statistics_fields = base::field_table<PeerStatistics>(),
         .stop = controlled.stop,
         .stop_in_emergency = controlled.stop,
         .scene = [&session] { return peer::scene_json(session.scene()); },
         .frames = [&session, seat] { return session.watch_peer(seat); },
         .hand = std::move(hand)});
}

template control::Subject subject_of(const Controlled<Session>& controlled);
template control::Subject subject_of(const Controlled<Recording>& controlled);
template control::Subject peer_subject(const Controlled<Session>& controlled, std::size_t seat);
template control::Subject peer_subject(const Controlled<Recording>& controlled, std::size_t seat);

} // namespace hapnet::lab::live
