// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/control/answer.hpp"

#include "proto/control/core/reply.hpp"
#include "proto/output/metrics.hpp"

#include <algorithm>
#include <array>
#include <chrono>
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

/// How often frames may be had at most: as often as clients are served.
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

/// The answer to a command without members, or that it has too many.
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

/// A request that takes time, or what is wrong with it.
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
    if (is_for_an_emulator(command)) {
        return control::refusal(fmt::format(
            "'{}' is for an emulator: a running peer cannot be changed; use show, scene, stats, "
            "metrics, watch, wait, keep, stop or estop",
            command));
    }
    return control::refusal("\"command\" must be one of show, scene, stats, metrics, watch, wait, "
                            "keep, stop, estop");
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
