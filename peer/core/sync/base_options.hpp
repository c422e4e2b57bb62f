// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/remote.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

namespace hapnet::peer {

// Options for the questions that the paper's pseudo-code leaves open, as far as they concern the
// algorithm itself. The first value of each is the default. docs/design/algorithms.md explains why.

/// The sign of a displacement: the one that moves the body forward, or the one printed in the
/// paper, which moves it back.
enum class DisplacementSign : std::uint8_t { current_minus_previous, previous_minus_current };
constexpr auto names_of(base::Tag<DisplacementSign> /*enum*/)
{
    return base::names("current-minus-previous", "previous-minus-current");
}

/// The peer that computes the remote displacement: the receiver, from two absolute positions, or
/// the sender, whose increments are lost with their messages.
enum class DisplacementFrom : std::uint8_t { positions, increments };
constexpr auto names_of(base::Tag<DisplacementFrom> /*enum*/)
{
    return base::names("positions", "increments");
}

/// The times at which a body that this hand does not touch is put where the remote has it.
enum class FollowWhile : std::uint8_t { touching, always };
constexpr auto names_of(base::Tag<FollowWhile> /*enum*/)
{
    return base::names("touching", "always");
}

enum class Follow : std::uint8_t { absolute, relative };
constexpr auto names_of(base::Tag<Follow> /*enum*/) { return base::names("absolute", "relative"); }

/// The place where the remote hand's force acts. On the hand, it counts twice.
enum class RemoteForceOn : std::uint8_t { body, body_and_hand };
constexpr auto names_of(base::Tag<RemoteForceOn> /*enum*/)
{
    return base::names("body", "body-and-hand");
}

/// The force that moves a body pushed by both hands: the sum, or that of the stronger hand alone.
enum class BothPush : std::uint8_t { sum, stronger };
constexpr auto names_of(base::Tag<BothPush> /*enum*/) { return base::names("sum", "stronger"); }

/// The axes along which the remote side acts on this copy.
enum class Axes : std::uint8_t { all, x };
constexpr auto names_of(base::Tag<Axes> /*enum*/) { return base::names("all", "x"); }

struct BaseOptions {
    DisplacementSign displacement = DisplacementSign::current_minus_previous;
    DisplacementFrom displacement_from = DisplacementFrom::positions;
    FollowWhile follow_while = FollowWhile::touching;
    Follow follow = Follow::absolute;
    /// The time constant with which a body with relative following is drawn to the place that the
    /// other peer has for it; nullopt: never.
    std::optional<base::Duration> bleed{std::chrono::milliseconds{500}};
    RemoteForceOn remote_force_on = RemoteForceOn::body;
    BothPush both_push = BothPush::sum;
    /// The least time for which the stronger hand keeps the body. It is never less than the round
    /// trip, which is twice the delay.
    base::Duration hysteresis{0};
    Stale stale = Stale::drop;
    /// The silence after which the remote hand counts as off the body; nullopt: its last state is
    /// used until it is stale.
    std::optional<base::Duration> let_go_after{};
    Axes axes = Axes::all;
    /// The time from the moment when both hands are off the body until the copy of the higher id
    /// begins to move to that of the lower id; nullopt: never.
    std::optional<base::Duration> settle_after{std::chrono::milliseconds{200}};
    base::Duration settle_within{std::chrono::milliseconds{100}};

    friend bool operator==(const BaseOptions&, const BaseOptions&) = default;
};

/// The allowed range of times that are parameters of algorithms.
inline constexpr base::Time parameter_time{base::Duration{0}, std::chrono::seconds{10}};

constexpr auto fields_of(base::Tag<BaseOptions> /*struct*/)
{
    return base::fields(
        "base",
        base::field("displacement", &BaseOptions::displacement,
                    "sign of a remote displacement; of use only with a relative follow (A1)"),
        base::field(
            "displacement_from", &BaseOptions::displacement_from,
            "formed by the receiver from two positions, or by the sender as increments (A2)"),
        base::field("follow_while", &BaseOptions::follow_while,
                    "a body that this hand leaves alone follows the other side while the other "
                    "hand touches it, or always (A3)"),
        base::field(
            "follow", &BaseOptions::follow,
            "to where the other side has the body, or by as much as the body moves there (A4)"),
        base::field(
            "bleed", &BaseOptions::bleed, parameter_time,
            "time constant with which a relative follow returns to the other side's position (A4)")
            .absent_as("never"),
        base::field("remote_force_on", &BaseOptions::remote_force_on,
                    "what the remote hand's force acts on (A5)"),
        base::field(
            "both_push", &BaseOptions::both_push,
            "force on a body that both hands push: the sum, or the stronger hand's alone (A6)"),
        base::field("hysteresis", &BaseOptions::hysteresis, parameter_time,
                    "least time for which the stronger hand keeps the body; never less than a "
                    "round trip (A6)"),
        base::field("stale", &BaseOptions::stale,
                    "what to do with overtaken messages and with duplicates (A7)"),
        base::field("let_go_after", &BaseOptions::let_go_after, parameter_time,
                    "silence after which the remote hand counts as off the body; until then its "
                    "last state holds (A8)")
            .absent_as("never"),
        base::field("axes", &BaseOptions::axes,
                    "directions in which the other side acts on this copy (A10)"),
        base::field(
            "settle_after", &BaseOptions::settle_after, parameter_time,
            "time from the moment both hands let go until the copies begin to agree again (A11)")
            .absent_as("never"),
        base::field("settle_within", &BaseOptions::settle_within, parameter_time,
                    "duration of that motion to the lower id's position (A11)"));
}

} // namespace hapnet::peer
