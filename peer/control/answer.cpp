// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/control/answer.hpp"

#include "proto/control/core/reply.hpp"
#include "proto/output/metrics.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::peer {

namespace {

using control::Members;
using Json = nlohmann::ordered_json;

bool is_for_an_emulator(std::string_view command)
{
    constexpr std::array<std::string_view, 4> commands{"set", "apply", "diff", "reset"};
    return std::find(commands.begin(), commands.end(), command) != commands.end();
}

/// The shortest interval between frames, which is the interval at which clients are served.
constexpr base::Duration frames_least = std::chrono::milliseconds{10};

std::string fine(const Json& members)
{
    Json reply{{"ok", true}};
    reply.update(members);
    return control::line_of(reply);
}

std::string stopped(const PeerControl& peer)
{
    peer.stop();
    return control::line_of(Json{{"ok", true}, {"stopping", true}});
}

std::string stopped_in_emergency(const PeerControl& peer)
{
    peer.stop_in_emergency();
    return control::line_of(Json{{"ok", true}, {"force", "off"}});
}

/// Returns the answer to a command without members, or an error if it has members.
template <typename Reply>
control::Answer answer_with(Members& members, Reply reply)
{
    const auto whole = members.finish(true);
    return whole ? reply() : control::refusal(whole.error().message);
}

std::string told_as_metrics(const PeerControl& peer)
{
    const Json statistics = peer.statistics();
    output::Metrics metrics;
    metrics.add(peer.statistics_fields, statistics,
                {{"peer", statistics.value("peer_id", Json{}).dump()}});
    return fine({{"metrics", metrics.json()}});
}

std::string kept(Members& members, const PeerControl& peer, base::TimePoint now)
{
    const auto request = members.finish(control::keep_request(members, peer.held));
    if (!request) return control::refusal(request.error().message);
    const base::TimePoint from = now - request->last.value_or(*peer.held);
    return control::keep_reply(peer.keep(request->name, from), from, now);
}

/// Returns a coordinate; NaN if the member is not a number.
double coordinate(Members& members, const char* key)
{
    const Json* value = members.find(key);
    const bool is_there = value != nullptr && value->is_number();
    return is_there ? value->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

/// True if the member is present and true. It may be missing.
bool is_true(Members& members, const char* key)
{
    const Json* value = members.find(key);
    if (value != nullptr && !value->is_boolean())
        members.fail(fmt::format("\"{}\" must be true or false", key));
    return value != nullptr && *value == true;
}

/// Returns the requested motion of the hand; nullopt to release the hand.
base::Result<std::optional<device::HandWish>> wish_in(Members& members)
{
    if (is_true(members, "let_go")) return std::optional<device::HandWish>{};
    const double x = coordinate(members, "x");
    const double y = coordinate(members, "y");
    const double z = coordinate(members, "z");
    const bool grips = is_true(members, "grip");
    const auto place = device::parse_page_place(x, y, z);
    if (!place) return tl::unexpected{place.error()};
    return device::HandWish{*place, grips};
}

std::string moved(Members& members, const PeerControl& peer)
{
    if (!peer.hand) {
        return control::refusal("'hand' moves the hand of --device page, and this peer has "
                                "another device");
    }
    const auto whole = members.finish(wish_in(members));
    if (!whole) return control::refusal(whole.error().message);
    if (!*whole) return control::refusal(whole->error().message);
    peer.hand(**whole);
    return control::line_of(Json{{"ok", true}});
}

/// Returns a request that takes time, or the error in it.
template <typename Request>
control::Answer begun(Members& members, Request request)
{
    auto whole = members.finish(std::move(request));
    if (!whole) return control::refusal(whole.error().message);
    return *std::move(whole);
}

} // namespace

control::Answer answer_to(std::string_view line, const PeerControl& peer, base::TimePoint now)
{
    const auto json = control::parse_object(line);
    if (!json) return control::refusal(json.error().message);
    Members members{*json};
    const std::string command = members.text("command");
    if (members.error()) return control::refusal(*members.error());
    if (command == "show") return answer_with(members, [&] { return fine(peer.show()); });
    if (command == "scene") return answer_with(members, [&] { return fine(peer.scene()); });
    if (command == "stop") return answer_with(members, [&] { return stopped(peer); });
    if (command == "estop") return answer_with(members, [&] { return stopped_in_emergency(peer); });
    if (command == "stats") {
        return answer_with(members, [&] { return control::statistics_reply(peer.statistics()); });
    }
    if (command == "metrics") {
        return answer_with(members, [&] { return told_as_metrics(peer); });
    }
    if (command == "wait") return begun(members, control::wait_request(members));
    if (command == "watch") return begun(members, control::watch_request(members, frames_least));
    if (command == "keep") return kept(members, peer, now);
    if (command == "hand") return moved(members, peer);
    const char* const hand = peer.hand ? "hand, " : ""; // offered only if the peer takes it
    if (is_for_an_emulator(command)) {
        return control::refusal(fmt::format(
            "'{}' is for an emulator: a running peer cannot be changed; use show, scene, stats, "
            "metrics, watch, wait, keep, {}stop or estop",
            command, hand));
    }
    return control::refusal(fmt::format("\"command\" must be one of show, scene, stats, metrics, "
                                        "watch, wait, keep, {}stop, estop",
                                        hand));
}

control::Subject subject_of(PeerControl peer)
{
    auto statistics = peer.statistics;
    auto frames = peer.frames;
    return {[peer = std::move(peer)](std::string_view line, base::TimePoint now) {
                return answer_to(line, peer, now);
            },
            std::move(statistics), std::move(frames)};
}

} // namespace hapnet::peer
