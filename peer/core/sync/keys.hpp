// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/algorithm.hpp"
#include "proto/base/quantity.hpp"

#include <array>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>

namespace hapnet::peer {

/// The names of an enum's values, as a person writes them.
template <typename Enum>
struct Words;

template <>
struct Words<DisplacementSign> {
    static constexpr std::array<std::string_view, 2> all{"current-minus-previous",
                                                         "previous-minus-current"};
};
template <>
struct Words<DisplacementFrom> {
    static constexpr std::array<std::string_view, 2> all{"positions", "increments"};
};
template <>
struct Words<FollowWhile> {
    static constexpr std::array<std::string_view, 2> all{"touching", "always"};
};
template <>
struct Words<Follow> {
    static constexpr std::array<std::string_view, 2> all{"absolute", "relative"};
};
template <>
struct Words<RemoteForceOn> {
    static constexpr std::array<std::string_view, 2> all{"body", "body-and-hand"};
};
template <>
struct Words<BothPush> {
    static constexpr std::array<std::string_view, 2> all{"sum", "stronger"};
};
template <>
struct Words<Stale> {
    static constexpr std::array<std::string_view, 2> all{"drop", "take"};
};
template <>
struct Words<Axes> {
    static constexpr std::array<std::string_view, 2> all{"all", "x"};
};
template <>
struct Words<VelocityRule> {
    static constexpr std::array<std::string_view, 3> all{"nominal", "arrival", "sender"};
};
template <>
struct Words<Horizon::Law> { // a fixed one is a time
    static constexpr std::array<std::string_view, 3> all{"none", "one-way", "packet-age"};
};

/// What a quantity may be, both ends included.
struct Limits {
    double least = 0.0;
    double most = 0.0;
};

/// A parameter of Options: its key in TOML, where it is kept, and a few words about it.
template <typename Options, typename Value>
struct Key {
    std::string_view key;
    Value Options::*member;
    std::string_view about;
    /// What stands for nullopt, of an optional.
    std::string_view absent = "never";
    Limits limits{};                          // of a number
    const base::QuantityKind* kind = nullptr; // of a number with a unit
};

// Clang 14 does not deduce the arguments of an aggregate by itself.
template <typename Options, typename Value>
Key(std::string_view, Value Options::*, std::string_view, std::string_view = {}, Limits = {},
    const base::QuantityKind* = nullptr) -> Key<Options, Value>;

/// How an algorithm is written: its name and its parameters besides those of the base algorithm.
/// Reading and printing go by it, so that neither can forget a parameter.
template <typename Algorithm>
struct Keys;

inline constexpr std::tuple base_keys{
    Key{"displacement", &BaseOptions::displacement, "the sign of a remote displacement (A1)"},
    Key{"displacement_from", &BaseOptions::displacement_from,
        "formed by the receiver, or by the sender (A2)"},
    Key{"follow_while", &BaseOptions::follow_while, "the other hand touches, or always (A3)"},
    Key{"follow", &BaseOptions::follow, "where the other body is, or as it moves (A4)"},
    Key{"bleed", &BaseOptions::bleed, "time constant of a relative follow's return (A4)", "never"},
    Key{"remote_force_on", &BaseOptions::remote_force_on, "what the remote force acts on (A5)"},
    Key{"both_push", &BaseOptions::both_push, "who moves what both push (A6)"},
    Key{"hysteresis", &BaseOptions::hysteresis,
        "the stronger keeps the body so long, and a round trip at least (A6)"},
    Key{"stale", &BaseOptions::stale, "messages that were overtaken, and duplicates (A7)"},
    Key{"let_go_after", &BaseOptions::let_go_after,
        "without a message; until then the last one holds (A8)", "never"},
    Key{"axes", &BaseOptions::axes, "along which the other side acts (A10)"},
    Key{"settle_after", &BaseOptions::settle_after, "both hands are off (A11)", "never"},
    Key{"settle_within", &BaseOptions::settle_within, "to the lower id's place (A11)"}};

template <>
struct Keys<BaseAlgorithm> {
    using Options = BaseOptions;
    static constexpr std::string_view name = "base";
    static constexpr std::tuple<> own{};
};

template <>
struct Keys<DeadReckoning> {
    using Options = DeadReckoningOptions;
    static constexpr std::string_view name = "dead-reckoning";
    static constexpr std::tuple own{
        Key{"velocity", &Options::velocity, "how far apart two messages are taken to be"},
        Key{"horizon", &Options::horizon, "how old a message is at its arrival; also a time"},
        Key{"horizon_memory",
            &Options::horizon_memory,
            "messages in the mean one-way delay",
            {},
            Limits{1.0, 1e6}},
        Key{"blend_within", &Options::blend_within, "a new prediction takes over from the last",
            "none"},
        Key{"ahead_max", &Options::ahead_max, "of a prediction, from the sending", "none"},
        Key{"speed_max",
            &Options::speed_max_m_per_s,
            "of the estimated velocity",
            {},
            Limits{0.0, 1000.0},
            &base::speed_kind},
        Key{"lead_max",
            &Options::lead_max_m,
            "of the prediction before the message's place",
            {},
            Limits{0.0, 100.0},
            &base::length_kind},
        Key{"gap_max", &Options::gap_max, "across a longer one there is no velocity"}};
};

template <>
struct Keys<EstimatorPredictor> {
    using Options = EstimatorPredictorOptions;
    static constexpr std::string_view name = "sep";
    static constexpr std::tuple own{
        Key{"time_constant", &Options::time_constant, "of the filters"},
        Key{"force_ahead_max", &Options::force_ahead_max, "of the force's prediction"},
        Key{"hip_ahead_beyond_delay", &Options::hip_ahead_beyond_delay,
            "and the median delay: of the prediction of the hand's place"},
        Key{"fade_after", &Options::fade_after,
            "and the median delay: then an old sample is predicted on less"},
        Key{"fade_within", &Options::fade_within, "down to not at all"},
        Key{"force_slew",
            &Options::force_slew_n_per_s,
            "of the predicted force",
            {},
            Limits{0.0, 1e6},
            &base::force_rate_kind},
        Key{"hip_slew",
            &Options::hip_slew_m_per_s,
            "of the predicted place",
            {},
            Limits{0.0, 1000.0},
            &base::speed_kind},
        Key{"gap_max", &Options::gap_max, "after a longer one the filters start anew"}};
};

} // namespace hapnet::peer
