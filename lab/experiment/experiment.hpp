// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/replay/hand_trace.hpp"
#include "device/simulated/omni_plant.hpp"
#include "device/simulated/operator.hpp"
#include "device/simulated/task.hpp"
#include "device/simulated/task_options.hpp"
#include "emulator/core/profile/profile.hpp"
#include "lab/experiment/impairment.hpp"
#include "lab/hands/population.hpp"
#include "lab/metrics/criteria.hpp"
#include "lab/metrics/verdict.hpp"
#include "peer/core/clock_policy.hpp"
#include "peer/core/send_policy.hpp"
#include "peer/core/sync/algorithm.hpp"
#include "proto/base/time.hpp"
#include "scene/description.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace hapnet::lab::experiment {

/// An algorithm with its name in the results.
struct NamedAlgorithm {
    std::string name;
    peer::Algorithm algorithm{};
};

/// The hands of the players that act as A and as B: operators' or recorded people's.
struct Hands {
    device::Operator left{};
    device::Operator right{};
    /// Intended motions of recorded people, instead of a task; nullptr: simulated hands play.
    std::shared_ptr<const hands::Population> people{};

    /// Returns the number of times that each seed is played: once for each of the people's trials.
    [[nodiscard]] std::size_t trials() const { return people ? people->trials.size() : 1; }
    /// Returns the trial; nullptr: there are no people.
    [[nodiscard]] const hands::Trial* trial(std::size_t index) const
    {
        return people ? &people->trials.at(index) : nullptr;
    }

    friend bool operator==(const Hands& a, const Hands& b)
    {
        const auto folder = [](const Hands& of) { return of.people ? of.people->folder : ""; };
        return a.left == b.left && a.right == b.right && folder(a) == folder(b);
    }
};

/// Returns the hand that follows the script of a recorded person. It is the nominal hand without
/// wander, as the recording contains the wander.
[[nodiscard]] device::Operator hand_of_people();

/// Returns "nominal", or "relaxed/firm" when the two hands differ; for people the name of their
/// folder.
[[nodiscard]] std::string name_of(const Hands& hands);

/// A scene with its name in the experiment.
struct NamedScene {
    std::string name;
    scene::Description scene{};
};

/// The recorded motion of a hand with the name of its file. Empty: the simulated hand plays.
struct NamedTrace {
    std::string name;
    std::shared_ptr<const device::HandTrace> trace{};
};

/// The name of a file of an experiment, and a hash of its contents.
struct NamedContents {
    std::string name;
    std::uint64_t hash = 0;
};

/// A key of the experiment that is varied, over a list of values or over a range.
struct Axis {
    std::string key;                   // in the form of the option --set: "both.delay"
    std::vector<std::string> values{}; // in the form of the text after the = of --set
    // A range of numbers with the same unit, "0ms" and "200ms", both ends included.
    std::optional<std::string> from{};
    std::optional<std::string> to{};
    std::optional<std::string> step{}; // step of the values from `from` on; nullopt: any value
    /// The value that counts as the truth. The results at the other values are compared with those
    /// at this one.
    std::optional<std::string> reference{};

    friend bool operator==(const Axis&, const Axis&) = default;
};

/// Points that are drawn on all axes at once, instead of all combinations of the axes' values.
struct LatinHypercube {
    std::uint32_t points = 0;
    std::uint32_t seed = 1; // seed for drawing the points; the sessions have their own

    friend bool operator==(const LatinHypercube&, const LatinHypercube&) = default;
};

/// The number of peers that play together, and the scene of the experiment in which they play.
struct Party {
    std::uint32_t peers = 2;
    std::optional<std::size_t> scene{}; // index in the scenes; nullopt: each task's own scene

    friend bool operator==(const Party&, const Party&) = default;
};

/// The range in which a search looks for the level at which half of the sessions fail. A coarse
/// scan goes upward from `from` in steps, to `to` at most. Then levels that count are played,
/// `resolution` or a multiple of it apart.
struct SearchRange {
    Impairment impairment{};
    ImpairmentLevel from{};
    ImpairmentLevel to{};
    ImpairmentLevel step{};
    ImpairmentLevel resolution{};

    friend bool operator==(const SearchRange&, const SearchRange&) = default;
};

/// The range of an impairment that is known at compile time.
template <Impairment what>
struct RangeOf : SearchRange {
    RangeOf() : SearchRange{what, {}, {}, {}, {}} {}
};

/// The impairments to be searched.
struct SearchRanges {
    std::optional<RangeOf<Impairment::delay>> delay{};
    std::optional<RangeOf<Impairment::jitter>> jitter{};
    std::optional<RangeOf<Impairment::random_loss>> random_loss{};
    std::optional<RangeOf<Impairment::burst_loss>> burst_loss{};
    std::optional<RangeOf<Impairment::interval>> interval{};

    friend bool operator==(const SearchRanges&, const SearchRanges&) = default;
};

/// The check of how sensitive the limits are to the method of measuring: the filters and hands with
/// which they are searched again. Its table in a text is [convention].
struct Sensitivity {
    std::vector<metrics::FilterOrder> filter_orders{
        metrics::FilterOrder::first, metrics::FilterOrder::second, metrics::FilterOrder::fourth};
    std::vector<Hands> hands{};
    std::vector<device::Task> tasks{};
    std::uint32_t seeds = 1;

    friend bool operator==(const Sensitivity&, const Sensitivity&) = default;
};

// The kinds of experiment.

/// Table 1: task P1 and the closed-loop tasks under the experiment's conditions.
struct Table1 {
    std::uint32_t rows_per_s = 100; // rows per second of the replays

    friend bool operator==(const Table1&, const Table1&) = default;
};

/// Fig. 6: the level of each impairment at which half of the sessions fail.
struct Limits {
    SearchRanges ranges{};
    /// The tiers for which limits are searched. A session fails if it is below the tier.
    std::vector<metrics::Tier> tiers{metrics::Tier::usable};
    /// The order of messages when jitter is searched.
    emulator::Order jitter_order = emulator::Order::free;
    std::optional<Sensitivity> sensitivity{};

    friend bool operator==(const Limits&, const Limits&) = default;
};

/// The ranges in the order of the impairments.
[[nodiscard]] std::vector<SearchRange> ranges_of(const Limits& limits);

/// Fig. 7: the motion of cubes and hands, and the forces, over time, for the first seed of the
/// first task.
struct Trajectories {
    std::uint32_t rows_per_s = 200;

    friend bool operator==(const Trajectories&, const Trajectories&) = default;
};

/// Quality of service: every combination of the delays, jitters and losses.
struct ImpairmentGrid {
    std::vector<ImpairmentLevel> delays{};
    std::vector<ImpairmentLevel> jitters{};
    std::vector<ImpairmentLevel> losses{};

    friend bool operator==(const ImpairmentGrid&, const ImpairmentGrid&) = default;
};

/// The two numbers of the paper that determine the criteria, found with the first algorithm.
struct Calibration {
    ImpairmentLevel delay{};
    ImpairmentLevel random_loss{};

    friend bool operator==(const Calibration&, const Calibration&) = default;
};

/// The claims about algorithms that go beyond the paper's. claim_cells() are their conditions.
/// Their tasks, hands and peers are fixed, too.
struct Claims {
    /// The number of seeds that a claim needs. The results show whether it had fewer.
    std::uint32_t judging_seeds = 200;

    friend bool operator==(const Claims&, const Claims&) = default;
};

using Kind = std::variant<Table1, Limits, Trajectories, ImpairmentGrid, Calibration, Claims>;

/// Returns the name of a kind: "table1", "limits", "trajectories", "plane", "calibration" or
/// "claims".
[[nodiscard]] std::string_view name_of(const Kind& kind);

/// The question of an experiment and its subjects: the sessions of every algorithm, task and seed.
struct Experiment {
    std::string title;
    Kind kind{};
    base::Duration duration{std::chrono::seconds{30}}; // length of a session, hands off included
    base::Duration tick{std::chrono::milliseconds{1}};
    std::uint32_t seeds = 10;
    std::uint32_t first_seed = 1001; // 1 to 40 are the seeds for calibrating criteria
    std::vector<NamedAlgorithm> algorithms{};
    std::vector<device::Task> tasks{};
    std::vector<std::uint32_t> peers{2};
    std::vector<NamedScene> scenes{}; // empty: each task's own scene
    Hands hands{};
    device::TaskOptions task_options{};
    /// Recorded hands of the players that act as A and as B; empty: there are none.
    std::vector<NamedTrace> replay{};
    /// The motions that the simulated hands of A and of B intend, instead of the task's; empty:
    /// there are none.
    std::vector<NamedTrace> script{};
    peer::SendPolicy send{};
    peer::Playout playout = peer::Playout::none;
    peer::ClockPolicy clock{};
    device::OmniPlant device{};
    /// True if a session is as long as its own script. `duration` is then that of the longest.
    bool is_as_long_as_scripts = false;
    bool energy_limit = false;
    bool keyed = false;    // the players seal their messages
    bool record = false;   // keep records of the first seed's sessions
    emulator::Path path{}; // the conditions that all sessions have in common
    /// The settings of single links. They take precedence over the conditions that the experiment
    /// varies.
    std::vector<emulator::PathPatch> links{};
    /// The changes of the network in every session, at times since its first hello.
    std::vector<emulator::Change> timeline{};
    std::vector<Axis> axes{}; // the experiment is repeated at each point of these axes
    std::optional<LatinHypercube> latin_hypercube{};
    /// Every file that was read for the experiment, by name. No key of the text holds them.
    std::vector<NamedContents> files{};
};

/// Returns the length of a session whose scripts end after `end_s` seconds. Hands are off for the
/// last 3 s; in a session below 6 s, for its last half.
[[nodiscard]] base::Duration session_length(double end_s);

/// Returns every combination of a number of peers and a scene.
[[nodiscard]] std::vector<Party> parties_of(const Experiment& experiment);

} // namespace hapnet::lab::experiment
