// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"
#include "lab/results/table.hpp"
#include "lab/results/task_limits.hpp"
#include "lab/results/verdicts.hpp"
#include "proto/base/csv.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::lab::results {

// Requirements on a network: the impairments at which each algorithm is still usable, in each task
// and for each tier, beside the classes of networks of ITU-T Y.1541.

/// The promises of a class of networks by ITU-T Recommendation Y.1541 (12/2011), Network
/// performance objectives for IP-based services, table 1.
struct NetworkClass {
    std::uint32_t number = 0;
    double delay_ms = 0.0;
    std::optional<double> delay_variation_ms{};
    double loss_percent = 0.0;
};
constexpr auto fields_of(base::Tag<NetworkClass> /*struct*/)
{
    using Class = NetworkClass;
    return base::fields(
        "network_classes", base::field("class", &Class::number, "Number of the class."),
        base::field("delay_ms", &Class::delay_ms, "Upper bound on the mean delay of one way."),
        base::field("delay_variation_ms", &Class::delay_variation_ms,
                    "Upper bound on how far the 99.9th percentile of the delay exceeds the least; "
                    "empty: the class promises nothing of it."),
        base::field("loss_percent", &Class::loss_percent,
                    "Upper bound on the share of packets that are lost."));
}

/// The classes 0 to 4. Class 5 promises nothing, and 6 and 7 are provisional.
inline constexpr std::array network_classes{
    NetworkClass{0, 100.0, 50.0, 0.1}, NetworkClass{1, 400.0, 50.0, 0.1},
    NetworkClass{2, 100.0, {}, 0.1}, NetworkClass{3, 400.0, {}, 0.1},
    NetworkClass{4, 1000.0, {}, 0.1}};

/// The levels that half of the sessions of an algorithm tolerate in a task. Each factor is varied
/// alone while the others have no impairment.
struct Requirement {
    std::string algorithm{};
    std::string task{};
    metrics::Tier tier{};
    std::optional<double> delay_ms{};
    Bound delay_bound{};
    std::optional<double> delay_variation_ms{};
    Bound delay_variation_bound{};
    std::optional<double> loss_percent{};
    Bound loss_bound{};
    std::optional<double> burst_of_100{};
    Bound burst_bound{};
    std::optional<double> interval_ms{};
    Bound interval_bound{};
    std::optional<double> messages_per_s{};
    std::optional<double> rate_kbit_s{};
    std::string classes{};
    std::uint32_t seeds = 0;
    std::uint32_t first_seed = 0;
    std::optional<std::uint32_t> peers{};
    std::optional<std::string> scene{};
};
constexpr auto fields_of(base::Tag<Requirement> /*struct*/)
{
    using Row = Requirement;
    constexpr base::Decimals one{1};
    constexpr base::Decimals two{2};
    constexpr base::Spare<base::Count> count_or_none{{2, 8}};
    constexpr base::Spare<base::Text> text_or_none{};
    return base::fields(
        "requirements", base::field("algorithm", &Row::algorithm, "Name in the experiment."),
        base::field("task", &Row::task,
                    "Name of the task; `worst`: of each factor the least of all tasks."),
        base::field("tier", &Row::tier, "What half of the sessions are at least."),
        base::field("delay_ms", &Row::delay_ms, one, "Constant delay of each way."),
        base::field("delay_bound", &Row::delay_bound,
                    "`=`: found; `>`: no level that was tried fails, and the value is the highest; "
                    "`none`: half of the sessions fail at rest, and there is no value."),
        base::field("delay_variation_ms", &Row::delay_variation_ms, two,
                    "How far the 99.9th percentile of the delay exceeds the least: 1.998 times the "
                    "jitter."),
        base::field("delay_variation_bound", &Row::delay_variation_bound, "As `delay_bound`."),
        base::field("loss_percent", &Row::loss_percent, two, "Random loss of each way."),
        base::field("loss_bound", &Row::loss_bound, "As `delay_bound`."),
        base::field("burst_of_100", &Row::burst_of_100, one,
                    "Messages lost in a row of every 100."),
        base::field("burst_bound", &Row::burst_bound, "As `delay_bound`."),
        base::field("interval_ms", &Row::interval_ms, one,
                    "Longest time from one message to the next, in whole ticks."),
        base::field("interval_bound", &Row::interval_bound, "As `delay_bound`."),
        base::field("messages_per_s", &Row::messages_per_s, one,
                    "Messages a second at that interval. Where its bound is `>`, fewer may be "
                    "enough."),
        base::field(
            "rate_kbit_s", &Row::rate_kbit_s, one,
            "Rate of these messages in the busiest direction, IP and UDP headers included."),
        base::field("classes", &Row::classes,
                    "Numbers of the classes of Y.1541 each of whose bounds is borne, or `none`."),
        base::field("seeds", &Row::seeds, "Number of seeds."),
        base::field("first_seed", &Row::first_seed, "The first of them; the others follow."),
        base::field("peers", &Row::peers, count_or_none,
                    "Number of peers, where it is not always two."),
        base::field("scene", &Row::scene, text_or_none,
                    "Name of the scene, where the experiment names one."));
}

/// True if the algorithm tolerates all impairments that the class allows, one factor at a time. A
/// class that does not limit the delay variation suffices only where no tried jitter fails.
[[nodiscard]] bool suffices(const NetworkClass& network, const Requirement& requirement);

/// True if an experiment searches all limits of a requirement.
[[nodiscard]] bool has_requirements(const experiment::Limits& limits);

/// Returns a row for each algorithm, party, tier and task, and for the worst of the tasks.
/// has_requirements() must be true for the experiment.
[[nodiscard]] std::vector<Requirement> make_requirements(const experiment::Experiment& experiment,
                                                         std::span<const TaskLimit> limits);

/// These functions return the tables requirements and network_classes.
[[nodiscard]] Table requirements_table(const std::vector<Requirement>& requirements);
[[nodiscard]] Table network_classes_table();

} // namespace hapnet::lab::results
