// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/remote.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

namespace hapnet::peer {

// The readings that the paper's pseudo-code leaves open, as far as they are the algorithm's own.
// The first of each is the default. docs/design/algorithms.md says why.

/// The sign of a displacement: as it moves the body on, or as printed, which moves it back.
enum class DisplacementSign : std::uint8_t { current_minus_previous, previous_minus_current };
/// The side that forms the remote displacement: the receiver, from two absolute positions, or the
/// sender, whose increments are lost with their messages.
enum class DisplacementFrom : std::uint8_t { positions, increments };
/// When a body that this hand does not touch is where the other side has it.
enum class FollowWhile : std::uint8_t { touching, always };
enum class Follow : std::uint8_t { absolute, relative };
/// The place where the remote hand's force acts; on the hand it counts twice.
enum class RemoteForceOn : std::uint8_t { body, body_and_hand };
/// The force that moves a body pushed by both: the sum, or the stronger hand's alone.
enum class BothPush : std::uint8_t { sum, stronger };
/// Along what the remote side acts on this copy.
enum class Axes : std::uint8_t { all, x };

struct BaseOptions {
    DisplacementSign displacement = DisplacementSign::current_minus_previous;
    DisplacementFrom displacement_from = DisplacementFrom::positions;
    FollowWhile follow_while = FollowWhile::touching;
    Follow follow = Follow::absolute;
    /// The time constant with which a body that follows relatively is drawn to where the other
    /// side has it; nullopt: never.
    std::optional<base::Duration> bleed{std::chrono::milliseconds{500}};
    RemoteForceOn remote_force_on = RemoteForceOn::body;
    BothPush both_push = BothPush::sum;
    /// For how long the stronger hand keeps the body at least; never less than the round trip,
    /// which is twice the delay.
    base::Duration hysteresis{0};
    Stale stale = Stale::drop;
    /// The remote hand counts as off the body after this silence; nullopt: its last state holds
    /// until it is stale.
    std::optional<base::Duration> let_go_after{};
    Axes axes = Axes::all;
    /// So long after both hands are off, the higher id's body begins to go to the lower id's place;
    /// nullopt: never.
    std::optional<base::Duration> settle_after{std::chrono::milliseconds{200}};
    base::Duration settle_within{std::chrono::milliseconds{100}};

    friend bool operator==(const BaseOptions&, const BaseOptions&) = default;
};

} // namespace hapnet::peer
