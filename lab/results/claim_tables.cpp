// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/claim_tables.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>

namespace hapnet::lab::results {

namespace {

using device::Task;
using Tasks = std::vector<Task>;
using Measure = std::function<std::optional<double>(const metrics::Scores&)>;

const Tasks pressed{Task::t1, Task::t2, Task::t3};
constexpr double unbounded = std::numeric_limits<double>::infinity();

/// What a number has to keep, and of which of the seeds.
struct Wanted {
    double least = -unbounded;
    double most = unbounded;
    bool of_mean = false; // of the seeds' mean, and not of each
};

/// A number of a claim: those of the seeds that judge, and of all.
struct Number {
    std::string name; // empty: the claim's only one
    std::vector<double> judging{};
    std::vector<double> all{};
    Wanted wanted{};
    std::string_view unit{};
};

double mean_of(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The value that `share` of them do not exceed (nearest rank).
double quantile_of(std::vector<double> values, double share)
{
    std::sort(values.begin(), values.end());
    const double rank = std::ceil(share * static_cast<double>(values.size()));
    return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

bool is_kept(const Number& number)
{
    const auto keeps = [&](double value) {
        return value >= number.wanted.least && value <= number.wanted.most;
    };
    if (number.wanted.of_mean) return keeps(mean_of(number.judging));
    return std::ranges::all_of(number.judging, keeps);
}

/// One value, or the two ends where both are bounded.
std::string with_unit(std::string text, const Number& number)
{
    if (!number.unit.empty()) text += fmt::format(" {}", number.unit);
    return number.name.empty() ? text : fmt::format("{}: {}", number.name, text);
}

/// The worst of the values, or what `share` of them keep.
std::string said(const Number& number, const std::vector<double>& values, double share)
{
    if (values.empty()) return with_unit("not measured", number);
    if (number.wanted.of_mean) return with_unit(fmt::format("{:.3g}", mean_of(values)), number);
    const double low = quantile_of(values, 1.0 - share);
    const double high = quantile_of(values, share);
    const bool has_least = number.wanted.least > -unbounded;
    const bool has_most = number.wanted.most < unbounded;
    if (has_least && has_most) return with_unit(fmt::format("{:.3g} to {:.3g}", low, high), number);
    return with_unit(fmt::format("{:.3g}", has_least ? low : high), number);
}

std::string accepted(const Number& number)
{
    const Wanted& wanted = number.wanted;
    std::string text;
    if (wanted.least > -unbounded && wanted.most < unbounded) {
        text = fmt::format("{:g} to {:g}", wanted.least, wanted.most);
    } else if (wanted.least > -unbounded) {
        text = fmt::format(">= {:g}", wanted.least);
    } else {
        text = fmt::format("<= {:g}", wanted.most);
    }
    return with_unit(text, number);
}

template <typename Say>
std::string joined(const std::vector<Number>& numbers, Say say)
{
    std::vector<std::string> parts;
    for (const Number& number : numbers) parts.push_back(say(number));
    return fmt::format("{}", fmt::join(parts, "; "));
}

// What the claims are about.

std::optional<double> mean_mm(const metrics::Scores& scores)
{
    if (!scores.discrepancy_m) return std::nullopt;
    return 1e3 * scores.discrepancy_m->mean;
}
std::optional<double> stiffness(const metrics::Scores& scores)
{
    return scores.stiffness_ratio[metrics::judged_press];
}
std::optional<double> vibration_mm(const metrics::Scores& scores)
{
    if (!scores.vibration_m) return std::nullopt;
    return 1e3 * scores.vibration_m->first;
}
std::optional<double> force_vibration_n(const metrics::Scores& scores)
{
    if (!scores.force_vibration_added_n) return std::nullopt;
    return scores.force_vibration_added_n->first;
}
std::optional<double> contact_lost_percent(const metrics::Scores& scores)
{
    if (!scores.contact_lost) return std::nullopt;
    return 1e2 * *scores.contact_lost;
}
std::optional<double> energy_mj(const metrics::Scores& scores)
{
    if (!scores.energy_taken_j) return std::nullopt;
    return 1e3 * *scores.energy_taken_j;
}

/// What a copy lends, stores in its contacts and in the cube's motion, and gives in a tick; of each
/// further copy what it stores. docs/design/algorithms.md derives it.
double energy_bound_mj(const experiment::ClaimCell& cell)
{
    const peer::RemoteProxyOptions proxy;
    constexpr double age_max_s = 0.4;
    constexpr double burst_s = 0.1; // the longest gap of a burst, and by far of 97 % loss: 0.3
    const double gap_s = cell.loss_percent > 0 ? age_max_s : cell.burst_of_100 > 0 ? burst_s : 0.0;
    const double age_s =
        std::min(age_max_s, 1e-3 * static_cast<double>(cell.delay_ms + cell.jitter_ms) + gap_s);
    constexpr double stored_mj = 15.0;
    constexpr double in_a_tick_mj = 3.3;
    return 1e3 * (proxy.account_j + proxy.power_w * age_s) + in_a_tick_mj +
           stored_mj * static_cast<double>(cell.peers);
}

/// The claims of one algorithm, one after the other.
class ClaimBook {
public:
    ClaimBook(const experiment::Experiment& experiment, const metrics::Criteria& criteria,
              const ClaimSessions& sessions)
        : experiment_{experiment}, criteria_{criteria}, sessions_{sessions}
    {}

    std::vector<Table> tables() &&
    {
        claim_usable();
        claim_stiffness();
        claim_forces();
        claim_agreement();
        claim_contact_and_energy();
        claim_three();
        claim_silence();
        return {std::move(claims_), std::move(quantiles_)};
    }

private:
    using Cells = std::vector<std::string_view>;

    [[nodiscard]] bool judges(std::uint32_t seed) const
    {
        return seed < experiment_.first_seed + judging_seeds(experiment_);
    }
    /// Of the first algorithm, in these conditions and tasks.
    [[nodiscard]] Number
    number(std::string name, const Cells& cells, const Tasks& tasks,
           const std::function<std::optional<double>(const ClaimSession&)>& measure) const
    {
        Number found{.name = std::move(name)};
        for (const ClaimSession& session : sessions_.sessions) {
            if (session.algorithm != experiment_.algorithms.front().name) continue;
            if (std::ranges::find(cells, session.cell->name) == cells.end()) continue;
            if (std::ranges::find(tasks, session.task) == tasks.end()) continue;
            const auto value = measure(session);
            if (!value) continue;
            found.all.push_back(*value);
            if (judges(session.seed)) found.judging.push_back(*value);
        }
        return found;
    }
    [[nodiscard]] Number of(std::string name, const Cells& cells, const Tasks& tasks,
                            const Measure& measure, const Wanted& wanted,
                            std::string_view unit = {}) const
    {
        Number found = number(std::move(name), cells, tasks,
                              [&](const ClaimSession& session) { return measure(session.scores); });
        found.wanted = wanted;
        found.unit = unit;
        return found;
    }
    /// The share of the sessions that are usable: all that judge are to be.
    [[nodiscard]] Number usable(std::string name, const Cells& cells) const
    {
        const Measure is_usable = [this](const metrics::Scores& scores) {
            return std::optional{judge(scores, criteria_).tier == metrics::Tier::unusable ? 0.0
                                                                                          : 100.0};
        };
        Number found = of(std::move(name), cells, pressed, is_usable,
                          {.least = 100.0, .of_mean = true}, "% usable");
        return found;
    }
    void add(std::string_view claim, const std::vector<Number>& numbers)
    {
        quantiles_.add(claim, joined(numbers, [](const Number& n) { return said(n, n.all, 0.9); }),
                       experiment_.seeds);
        const auto is_empty = [](const Number& n) { return n.judging.empty(); };
        const std::string_view verdict = std::ranges::any_of(numbers, is_empty)  ? "undecided"
                                         : std::ranges::all_of(numbers, is_kept) ? "met"
                                                                                 : "missed";
        claims_.add(claim, joined(numbers, [](const Number& n) { return said(n, n.judging, 1.0); }),
                    joined(numbers, accepted), verdict);
    }

    void claim_usable()
    {
        add("bears 300 ms of delay", {usable("100 ms", {"100ms"}), usable("160 ms", {"160ms"}),
                                      usable("200 ms", {"200ms"}), usable("300 ms", {"300ms"})});
        add("bears 30 ms of jitter", {usable("", {"jitter-30ms"})});
        add("bears 97 % loss and bursts of 90",
            {usable("97 %", {"loss-97"}), usable("90 of 100", {"burst-90"})});
        // The vibration is reported, and judged by the first number alone.
        add("bears 200 ms and 30 ms of jitter and 97 % loss at once",
            {usable("", {"all"}),
             of("vibration", {"all"}, pressed, vibration_mm,
                {.most = criteria_.usable.vibration_max_m.first * 1e3}, "mm")});
    }
    void claim_stiffness()
    {
        const Tasks press{Task::t2};
        constexpr Wanted each{.least = 0.75, .most = 1.25};
        constexpr Wanted mean{.least = 0.85, .most = 1.15, .of_mean = true};
        add("stiffness at 1 Hz at 100 and 200 ms", {of("100 ms", {"100ms"}, press, stiffness, each),
                                                    of("mean", {"100ms"}, press, stiffness, mean),
                                                    of("200 ms", {"200ms"}, press, stiffness, each),
                                                    of("mean", {"200ms"}, press, stiffness, mean)});
        add("stiffness at 1 Hz at 300 ms", {of("", {"300ms"}, press, stiffness, {.least = 0.6})});
        add("stiffness at 1 Hz at 200 ms of other hands",
            {of("relaxed", {"200ms-relaxed"}, press, stiffness, each),
             of("firm", {"200ms-firm"}, press, stiffness, {.least = 0.65})});
    }
    void claim_forces()
    {
        const Cells delays{"100ms", "160ms", "200ms", "300ms"};
        add("force vibration added to 300 ms",
            {of("T1 to T3", delays, pressed, force_vibration_n, {.most = 0.08}, "N"),
             of("T6", delays, {Task::t6}, force_vibration_n, {.most = 0.1}, "N")});
    }
    void claim_agreement()
    {
        const auto at = [&](std::string name, std::string_view cell, Task task, double most) {
            return of(std::move(name), {cell}, {task}, mean_mm, {.most = most, .of_mean = true},
                      "mm");
        };
        add("mean discrepancy at 160 ms",
            {at("P1", "160ms", Task::p1, 6.0), at("T1", "160ms", Task::t1, 7.0),
             at("T2", "160ms", Task::t2, 1.0), at("T3", "160ms", Task::t3, 2.5)});
        add("mean discrepancy of T3 at 200 and 300 ms",
            {at("200 ms", "200ms", Task::t3, 3.5), at("300 ms", "300ms", Task::t3, 8.0)});
    }
    void claim_contact_and_energy()
    {
        const auto lost = [&](std::string name, std::string_view cell, double most) {
            return of(std::move(name), {cell}, {Task::t3}, contact_lost_percent, {.most = most},
                      "%");
        };
        add("contact lost added in T3",
            {lost("100 ms", "100ms", 8.0), lost("200 ms", "200ms", 12.0)});
        Cells all;
        for (const auto& cell : experiment::claim_cells()) all.push_back(cell.name);
        add("energy drawn by all hands", {of("", all, pressed, energy_mj, {.most = 50.0}, "mJ")});
        Number margin = number("", all, {Task::t1, Task::t2, Task::t3, Task::t6, Task::p1},
                               [](const ClaimSession& session) -> std::optional<double> {
                                   const auto drawn = energy_mj(session.scores);
                                   if (!drawn) return std::nullopt;
                                   return energy_bound_mj(*session.cell) - *drawn;
                               });
        margin.wanted.least = 0.0;
        margin.unit = "mJ";
        add("energy of all hands above its bound, by", {margin});
    }
    void claim_three()
    {
        const auto ratio = [&](std::string name, std::string_view of_three,
                               std::string_view of_two) {
            Number worst{.name = std::move(name), .wanted = {.most = 1.3}, .unit = "x of two"};
            for (const Task task : pressed) {
                const Number three = of("", {of_three}, {task}, mean_mm, {});
                const Number two = of("", {of_two}, {task}, mean_mm, {});
                if (three.judging.empty() || two.judging.empty()) continue;
                worst.judging.push_back(mean_of(three.judging) / mean_of(two.judging));
                worst.all.push_back(mean_of(three.all) / mean_of(two.all));
            }
            return worst;
        };
        add("three peers at 200 ms and at 97 % loss",
            {usable("200 ms", {"200ms-three"}), usable("97 %", {"loss-97-three"}),
             ratio("mean at 200 ms", "200ms-three", "200ms"),
             ratio("mean at 97 %", "loss-97-three", "loss-97")});
    }
    void claim_silence()
    {
        Number apart{.name = {}, .wanted = {.most = 0.1}, .unit = "mm"};
        for (const double metres : sessions_.silence_m) apart.judging.push_back(1e3 * metres);
        apart.all = apart.judging;
        add("copies apart a second after silence on a healed network", {apart});
    }

    const experiment::Experiment& experiment_;
    const metrics::Criteria& criteria_;
    const ClaimSessions& sessions_;
    Table claims_{"claims", columns_in("claim,value,accept,verdict")};
    Table quantiles_{"claims_quantiles", columns_in("claim,quantile,seeds")};
};

using Stiffness = decltype(metrics::Metrics::stiffness_n_per_m);

/// What each side feels on a perfect network, the median of the seeds: in one session a hand that
/// holds against the press is kept by the friction of its device, or slips as it wavers.
Stiffness usual_stiffness(std::span<const experiment::JobResult> of_seeds)
{
    Stiffness usual{};
    for (std::size_t press = 0; press < usual.size(); ++press) {
        for (std::size_t side = 0; side < usual[press].size(); ++side) {
            std::vector<double> felt;
            for (const experiment::JobResult& result : of_seeds) {
                const auto& one = std::get<experiment::SessionResult>(result);
                if (const auto value = one.perfect.stiffness_n_per_m[press][side])
                    felt.push_back(*value);
            }
            if (!felt.empty()) usual[press][side] = quantile_of(felt, 0.5);
        }
    }
    return usual;
}

} // namespace

ClaimSessions claim_sessions_of(const experiment::Experiment& experiment,
                                std::span<const experiment::JobResult> results)
{
    ClaimSessions found;
    std::size_t next = 0;
    for (const auto& algorithm : experiment.algorithms) {
        for (const experiment::ClaimCell& cell : experiment::claim_cells()) {
            for (const Task task : cell.tasks) {
                const auto of_seeds = results.subspan(next, experiment.seeds);
                const auto due = usual_stiffness(of_seeds);
                for (std::uint32_t seed = 0; seed < experiment.seeds; ++seed) {
                    const auto& one = std::get<experiment::SessionResult>(of_seeds[seed]);
                    metrics::Metrics perfect = one.perfect;
                    perfect.stiffness_n_per_m = due;
                    found.sessions.push_back({&cell, algorithm.name, task,
                                              experiment.first_seed + seed,
                                              scores_of(one.metrics, perfect)});
                }
                next += experiment.seeds;
            }
        }
    }
    for (std::uint32_t seed = 0; seed < judging_seeds(experiment); ++seed) {
        const auto& one = std::get<experiment::SilenceResult>(results[next++]);
        found.silence_m.push_back(one.apart_m);
    }
    return found;
}

std::vector<Table> claim_tables(const experiment::Experiment& experiment,
                                const metrics::Criteria& criteria, const ClaimSessions& sessions)
{
    return ClaimBook{experiment, criteria, sessions}.tables();
}

Table claim_sessions_table(const metrics::Criteria& criteria, const ClaimSessions& sessions)
{
    Table table{"sessions",
                columns_in("algorithm,condition,task,hands,peers,delay_ms,jitter_ms,loss_percent,"
                           "burst_of_100,seed,mean_mm:3,max_mm:3,vibration_mm:3,stiffness_ratio:4,"
                           "force_vibration_n:4,force_above_2hz_n:4?,force_discrepancy:4,"
                           "contact_lost:4,energy_mj:4,scored_share:4,tier")};
    for (const ClaimSession& session : sessions.sessions) {
        const metrics::Scores& scores = session.scores;
        const experiment::ClaimCell& cell = *session.cell;
        std::optional<double> max_mm, swings_n;
        if (scores.discrepancy_m) max_mm = 1e3 * scores.discrepancy_m->max;
        if (scores.force_above_2hz_added_n) swings_n = scores.force_above_2hz_added_n->first;
        table.add(session.algorithm, cell.name, name_of(session.task), cell.hands, cell.peers,
                  static_cast<double>(cell.delay_ms), static_cast<double>(cell.jitter_ms),
                  static_cast<double>(cell.loss_percent), static_cast<double>(cell.burst_of_100),
                  session.seed, mean_mm(scores), max_mm, vibration_mm(scores), stiffness(scores),
                  force_vibration_n(scores), swings_n, scores.force_discrepancy,
                  scores.contact_lost, energy_mj(scores), scores.scored_share,
                  judge(scores, criteria).tier);
    }
    return table;
}

} // namespace hapnet::lab::results
