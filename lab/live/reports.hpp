// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/control/statistics.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/version.hpp"
#include "proto/telemetry/frame.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

namespace hapnet::lab::live {

/// The beginning of both replies of a peer in virtual time.
struct PeerIntroduction {
    std::string_view program = "hapnet-lab";
    std::string_view version = base::version();
    std::int64_t peer_id = 0;
    device::Task task{};
    std::string scene;
    std::string algorithm;
    std::uint64_t seed = 0;
    base::Duration duration{};
    std::string_view device = "simulated Omni, in virtual time";
    bool takes_hand = false;
    double force_limit_n = 0.0;
    base::Duration elapsed{};
};
constexpr auto fields_of(base::Tag<PeerIntroduction>)
{
    using P = PeerIntroduction;
    return base::fields(
        "introduction", base::member("program", &P::program, "The program that plays it."),
        base::member("version", &P::version, "Its version."),
        base::member("peer_id", &P::peer_id, "The number of its seat, from 1."),
        base::member("task", &P::task, "The task that is played."),
        base::member("scene", &P::scene, "The name of the scene."),
        base::member("algorithm", &P::algorithm, "What the experiment calls the algorithm."),
        base::member("seed", &P::seed, "The seed of the session."),
        base::member("duration_s", &P::duration, "The length of the session."),
        base::member("device", &P::device, "The device in words."),
        base::member("takes_hand", &P::takes_hand, "True if the request `hand` moves its device."),
        base::member("force_limit_n", &P::force_limit_n, "The limit of the governor."),
        base::member("elapsed_s", &P::elapsed, "Virtual time since the beginning.")
            .gauge("hapnet_peer_elapsed"));
}

/// The statistics of a peer, as far as they exist without sockets and a clock.
struct PeerStatistics {
    PeerIntroduction introduction;
    peer::TickReport tick;
    peer::Counters messages;
    peer::GovernorFigures governor;
    bool is_valid = true;
};
constexpr auto fields_of(base::Tag<PeerStatistics>)
{
    using P = PeerStatistics;
    return base::fields(
        "peer in virtual time", base::part(&P::introduction),
        base::member("tick", &P::tick, "Its ticks, which are never late."),
        base::member("messages", &P::messages, "What came from the others."),
        base::member("governor", &P::governor, "What stands between the scene and the hand."),
        base::member("valid", &P::is_valid, "Virtual time is never late."));
}

/// The distance of the copies in another session that plays in parallel with the first. It is shown
/// in the first session's frames.
struct OtherSession {
    std::string algorithm;
    base::Position cube_a;
    base::Position cube_b;
};
constexpr auto fields_of(base::Tag<OtherSession>)
{
    using O = OtherSession;
    constexpr int nm_decimals_of_mm = 6;
    return base::fields(
        "other session", base::member("algorithm", &O::algorithm, "Its algorithm."),
        base::computed<O>(
            "apart_mm",
            [](const O& other) { return std::abs(other.cube_a.x() - other.cube_b.x()) * 1e3; },
            "|x_A - x_B| of the body.")
            .rounded(nm_decimals_of_mm),
        base::computed<O>(
            "cube_a", [](const O& other) { return telemetry::list_of(other.cube_a.value); },
            "Where A has the body, m.")
            .rounded(telemetry::si_decimals),
        base::computed<O>(
            "cube_b", [](const O& other) { return telemetry::list_of(other.cube_b.value); },
            "Where B has it.")
            .rounded(telemetry::si_decimals));
}

} // namespace hapnet::lab::live
