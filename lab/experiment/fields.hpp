// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"
#include "proto/base/describe.hpp"

namespace hapnet::lab::experiment {

// The keys of an experiment's text, for reading and printing: docs/formats/experiment.md.

inline constexpr std::uint32_t seeds_max = 1000;

/// The name of a kind. Reading it gives the kind's own keys their defaults.
struct KindFormat {
    void read(const base::Node& node, Kind& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const Kind& kind) const;
    [[nodiscard]] std::string describe() const;
};

/// Names of algorithms. The files of a user's own algorithms are read elsewhere.
struct AlgorithmNames {
    void read(const base::Node& node, std::vector<NamedAlgorithm>& target,
              base::Reading& reading) const;
    [[nodiscard]] std::string print(const std::vector<NamedAlgorithm>& algorithms) const;
    [[nodiscard]] std::string describe() const { return "a list of names, or one name"; }
};

/// One task, or a list of different ones.
struct TaskNames {
    void read(const base::Node& node, std::vector<device::Task>& target,
              base::Reading& reading) const;
    [[nodiscard]] std::string print(const std::vector<device::Task>& tasks) const;
    [[nodiscard]] std::string describe() const;
};

/// One tier that a session may miss, or a list of different ones.
struct TierNames {
    void read(const base::Node& node, std::vector<metrics::Tier>& target,
              base::Reading& reading) const;
    [[nodiscard]] std::string print(const std::vector<metrics::Tier>& tiers) const;
    [[nodiscard]] std::string describe() const
    {
        return "a list of different tiers, or one: `\"usable\"`, `\"good\"`";
    }
};

/// One number of peers, or a list of different ones.
struct PeerCounts {
    void read(const base::Node& node, std::vector<std::uint32_t>& target,
              base::Reading& reading) const;
    [[nodiscard]] std::string print(const std::vector<std::uint32_t>& counts) const;
    [[nodiscard]] std::string describe() const;
};

/// One scene, or a list of different ones: built-in ones by their names, or files.
struct SceneNames {
    void read(const base::Node& node, std::vector<NamedScene>& target,
              base::Reading& reading) const;
    [[nodiscard]] std::string print(const std::vector<NamedScene>& scenes) const;
    [[nodiscard]] std::string describe() const
    {
        return "the name of a built-in scene, a file, or a list of different ones";
    }
};

/// A file for each side, A and B; empty where the simulated hand plays.
struct TracesFormat {
    void read(const base::Node& node, std::vector<NamedTrace>& target,
              base::Reading& reading) const;
    [[nodiscard]] std::string print(const std::vector<NamedTrace>& traces) const;
    [[nodiscard]] std::string describe() const
    {
        return "a list of two files, of A and of B; an empty text where the simulated hand plays";
    }
};

/// One operator for both sides, or a list of two, for A and B. Or people: a folder of recorded
/// hands, or a table with `people = "folder"` and the properties of the hand that follows them.
struct HandsFormat {
    void read(const base::Node& node, Hands& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const Hands& hands) const;
    [[nodiscard]] std::string describe() const
    {
        return "an operator, a list of two: of A and of B, or the folder of recorded people";
    }
};

/// One axis, or a list of them.
struct AxesFormat {
    void read(const base::Node& node, std::vector<Axis>& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const std::vector<Axis>& axes) const;
    [[nodiscard]] std::string describe() const { return "a table, or a list of tables"; }
};

/// One level of an impairment, or a list of levels.
struct LevelsFormat {
    LevelFormat level{};

    void read(const base::Node& node, std::vector<ImpairmentLevel>& target,
              base::Reading& reading) const;
    [[nodiscard]] std::string print(const std::vector<ImpairmentLevel>& levels) const;
    [[nodiscard]] std::string describe() const { return level.describe() + ", or a list"; }
};

/// Reports an error if a range cannot be searched.
void check(const SearchRange& range, base::Place place, base::Reading& reading);

/// A range that can be searched.
struct RangeFormat : base::Table {
    template <typename T>
    void read(const base::Node& node, T& target, base::Reading& reading) const
    {
        base::Table::read(node, target, reading);
        if (reading.is_good()) check(target, node.place, reading);
    }
};

/// A table with at least one range.
struct RangesFormat : base::Table {
    void read(const base::Node& node, SearchRanges& target, base::Reading& reading) const;
};

template <Impairment what>
constexpr auto fields_of(base::Tag<RangeOf<what>> /*struct*/)
{
    constexpr LevelFormat level{what};
    return base::fields(
        base::name_of(what),
        base::field("from", &SearchRange::from, level, "where the coarse scan begins"),
        base::field("to", &SearchRange::to, level, "the top of the range").required(),
        base::field("step", &SearchRange::step, level,
                    "of the coarse scan; a multiple of `resolution`")
            .required(),
        base::field("resolution", &SearchRange::resolution, level,
                    "the least distance of the levels that count")
            .required());
}

constexpr auto fields_of(base::Tag<SearchRanges> /*struct*/)
{
    return base::fields("limit", base::field("delay", &SearchRanges::delay, RangeFormat{}),
                        base::field("jitter", &SearchRanges::jitter, RangeFormat{}),
                        base::field("random-loss", &SearchRanges::random_loss, RangeFormat{}),
                        base::field("burst-loss", &SearchRanges::burst_loss, RangeFormat{}),
                        base::field("interval", &SearchRanges::interval, RangeFormat{}));
}

constexpr auto fields_of(base::Tag<Sensitivity> /*struct*/)
{
    return base::fields(
        "convention",
        base::field("filter_orders", &Sensitivity::filter_orders,
                    base::List<metrics::FilterOrderFormat>{{}, 1}, "filters behind metric A"),
        base::field("hands", &Sensitivity::hands, base::List<HandsFormat>{{}, 1},
                    "hands, each as in `hands`")
            .required(),
        base::field("tasks", &Sensitivity::tasks, TaskNames{}, "of these searches").required(),
        base::field("seeds", &Sensitivity::seeds, base::Count{0, seeds_max},
                    "of these searches; 0: they are left out")
            .required());
}

inline constexpr base::Count rows_format{1, 1000};

constexpr auto fields_of(base::Tag<Table1> /*struct*/)
{
    return base::fields("table1", base::field("rows_per_second", &Table1::rows_per_s, rows_format,
                                              "of the replays"));
}

constexpr auto fields_of(base::Tag<Limits> /*struct*/)
{
    return base::fields("limits", base::field("limit", &Limits::ranges, RangesFormat{}).required(),
                        base::field("tiers", &Limits::tiers, TierNames{},
                                    "what a session has to be; each has limits of its own"),
                        base::field("jitter_order", &Limits::jitter_order,
                                    "whether messages under searched jitter overtake one another"),
                        base::field("convention", &Limits::sensitivity));
}

constexpr auto fields_of(base::Tag<Trajectories> /*struct*/)
{
    return base::fields("trajectories", base::field("rows_per_second", &Trajectories::rows_per_s,
                                                    rows_format, "of the curves"));
}

constexpr auto fields_of(base::Tag<ImpairmentGrid> /*struct*/)
{
    return base::fields(
        "plane",
        base::field("delay", &ImpairmentGrid::delays, LevelsFormat{{Impairment::delay}},
                    "the delays")
            .required(),
        base::field("jitter", &ImpairmentGrid::jitters, LevelsFormat{{Impairment::jitter}},
                    "the jitters, each with every delay")
            .required(),
        base::field("loss", &ImpairmentGrid::losses, LevelsFormat{{Impairment::random_loss}},
                    "the shares of random loss, each with every delay and jitter")
            .required());
}

constexpr auto fields_of(base::Tag<Calibration> /*struct*/)
{
    return base::fields("calibration",
                        base::field("delay", &Calibration::delay, LevelFormat{Impairment::delay},
                                    "up to which base is to be usable")
                            .required(),
                        base::field("random-loss", &Calibration::random_loss,
                                    LevelFormat{Impairment::random_loss},
                                    "up to which base is to be usable")
                            .required());
}

constexpr auto fields_of(base::Tag<Claims> /*struct*/)
{
    return base::fields(
        "claims", base::field("judging_seeds", &Claims::judging_seeds, base::Count{1, seeds_max},
                              "number of seeds that a claim needs; `claims_numbers.csv` says how "
                              "many played"));
}

/// True if the keys of a kind are in a table of its own name, and not among those of the
/// experiment.
template <typename OneKind>
inline constexpr bool has_own_table =
    std::is_same_v<OneKind, ImpairmentGrid> || std::is_same_v<OneKind, Calibration>;

constexpr auto fields_of(base::Tag<Axis> /*struct*/)
{
    return base::fields(
        "axis",
        base::field("key", &Axis::key, "any key of the experiment, as after `--set`").required(),
        base::field("values", &Axis::values, base::List<base::Text>{{}, 1},
                    "its values, as after the = of `--set`"),
        base::field("from", &Axis::from, "instead of `values`: the least, a number with its unit"),
        base::field("to", &Axis::to, "the most, in the same unit"),
        base::field("step", &Axis::step,
                    "from one value to the next; a latin hypercube can do without"),
        base::field("reference", &Axis::reference,
                    "one of the values, against which `precision.csv` holds the others"));
}

inline constexpr std::uint32_t points_max = 10'000;

constexpr auto fields_of(base::Tag<LatinHypercube> /*struct*/)
{
    return base::fields("latin-hypercube",
                        base::field("points", &LatinHypercube::points, base::Count{2, points_max},
                                    "number of points")
                            .required(),
                        base::field("seed", &LatinHypercube::seed, base::Count{0, 1'000'000'000},
                                    "by which they are drawn"));
}

/// A session's length, or "script", which is read as 0 until the scripts are known.
struct DurationFormat {
    void read(const base::Node& node, base::Duration& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(base::Duration value) const { return time().print(value); }
    [[nodiscard]] std::string example() const { return time().example(); }
    [[nodiscard]] std::string describe() const { return time().describe() + ", or \"script\""; }

private:
    [[nodiscard]] static constexpr base::Time time()
    {
        using namespace std::chrono_literals;
        return {100ms, 10min};
    }
};

constexpr auto fields_of(base::Tag<Experiment> /*struct*/)
{
    using namespace std::chrono_literals;
    return base::fields(
        "experiment",
        base::field("title", &Experiment::title, "names the folder's contents, with the kind"),
        base::field("kind", &Experiment::kind, KindFormat{}, "what to find out").required(),
        base::field(
            "duration", &Experiment::duration, DurationFormat{},
            "length of a session, hands off included: the last 3 s, below 6 s the last half. "
            "`\"script\"`: as long as the longest `script` or `replay`, of people each trial "
            "as long as its own scripts, and hands off")
            .always(),
        base::field("tick", &Experiment::tick, base::Time{100us, 10ms}, "of the haptic loops")
            .always(),
        base::field("seeds", &Experiment::seeds, base::Count{1, seeds_max},
                    "number of seeds, each of the hands and of the network; each trial of people "
                    "is played with all of them")
            .always(),
        base::field("first_seed", &Experiment::first_seed, base::Count{1, 1'000'000'000},
                    "the first of them; the others follow")
            .always(),
        base::field("algorithms", &Experiment::algorithms, AlgorithmNames{},
                    "built-in ones, or those of `[algorithm.NAME]`")
            .always(),
        base::field("tasks", &Experiment::tasks, TaskNames{}, "what the hands play").required(),
        base::field("peers", &Experiment::peers, PeerCounts{}, "how many play together"),
        base::field("scene", &Experiment::scenes, SceneNames{},
                    "where they play; without it each task has its own"),
        base::field("hands", &Experiment::hands, HandsFormat{}, "whose hands play").always(),
        base::field("task_options", &Experiment::task_options, base::Table{},
                    "options of the tasks"),
        base::field("replay", &Experiment::replay, TracesFormat{},
                    "hands that move as recorded, CSV as for `hapnet-peer --device replay:FILE`"),
        base::field("script", &Experiment::script, TracesFormat{},
                    "where simulated hands mean to be instead of the task's: such files, too"),
        base::field("send", &Experiment::send, peer::SendPolicyFormat{},
                    "when a player sends a message, as `hapnet-peer --send`"),
        base::field("playout", &Experiment::playout,
                    "when a message that has arrived counts, as `hapnet-peer --playout`"),
        base::field("clock", &Experiment::clock, peer::ClockPolicyFormat{},
                    "knowledge of the other players' clocks, as `hapnet-peer --clock`; where they "
                    "are synchronised within an error, they are apart by twice that"),
        base::field("device", &Experiment::device, base::Table{}, "the simulated devices"),
        base::field("energy_limit", &Experiment::energy_limit,
                    "limits the energy into each hand as hapnet-peer does"),
        base::field("keyed", &Experiment::keyed,
                    "the players seal their messages, as `hapnet-peer --key` does"),
        base::field("record", &Experiment::record,
                    "keeps what each player of the first seed's sessions would have recorded"),
        base::field("axis", &Experiment::axes, AxesFormat{},
                    "the same experiment again at each value of one or several of its keys"),
        base::field("latin_hypercube", &Experiment::latin_hypercube, base::Table{},
                    "points drawn from all axes, instead of every combination"));
}

/// Returns the experiment of a text that names only a kind and tasks.
[[nodiscard]] Experiment usual_experiment();

} // namespace hapnet::lab::experiment
