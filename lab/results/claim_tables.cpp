// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/claim_tables.hpp"

#include "lab/metrics/paired.hpp"
#include "proto/base/names.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
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

/// The rule by which a number is judged: nine of ten sessions must keep its bounds, or their mean,
/// or each of them.
enum class JudgedBy : std::uint8_t { quantile, mean, each };
constexpr auto names_of(base::Tag<JudgedBy>) { return base::names("quantile", "mean", "worst"); }
constexpr double kept_share = 0.9;

/// The bounds that a number must keep.
struct Wanted {
    double least = -unbounded;
    double most = unbounded;
    JudgedBy by = JudgedBy::quantile;
};

/// A number of a claim, over all seeds.
struct Number {
    std::string name; // empty: it is the claim's only number
    std::vector<double> values{};
    Wanted wanted{};
    std::string_view unit{};
};

double mean_of(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// A value that is compared with one or both bounds of a number, with its interval.
struct HeldValue {
    double value = 0.0;
    metrics::Interval interval{};
    double least = -unbounded;
    double most = unbounded;

    [[nodiscard]] bool is_met() const { return interval.low >= least && interval.high <= most; }
    [[nodiscard]] bool is_missed() const { return interval.high < least || interval.low > most; }
    /// Returns the distance of the value beyond its bounds; negative within them.
    [[nodiscard]] double shortfall() const { return std::max(least - value, value - most); }
};

/// Returns the values to compare with the bounds: one for a mean or for the worst, and for
/// quantiles one for each bound. Returns none where nothing was measured.
std::vector<HeldValue> held_values(const Number& number)
{
    const auto& [least, most, by] = number.wanted;
    const auto& values = number.values;
    std::vector<HeldValue> judged;
    if (values.empty()) return judged;
    const auto add_quantile = [&](double share, double low, double high) {
        judged.push_back({metrics::quantile_of(values, share),
                          metrics::interval_of_quantile(values, share), low, high});
    };
    if (by == JudgedBy::mean) {
        judged.push_back({mean_of(values), metrics::interval_of_mean(values), least, most});
    } else if (by == JudgedBy::each) {
        const auto [lowest, highest] = std::ranges::minmax(values);
        const bool is_low = least - lowest > highest - most;
        judged.push_back({is_low ? lowest : highest, {lowest, highest}, least, most});
    } else {
        if (least > -unbounded) add_quantile(1.0 - kept_share, least, unbounded);
        if (most < unbounded) add_quantile(kept_share, -unbounded, most);
    }
    return judged;
}

/// True if the number keeps its bounds; nullopt: it was not measured, or its interval contains a
/// bound.
std::optional<bool> is_kept(const Number& number)
{
    const auto judged = held_values(number);
    if (judged.empty()) return std::nullopt;
    if (number.wanted.by == JudgedBy::each) return judged.front().is_met();
    if (std::ranges::all_of(judged, &HeldValue::is_met)) return true;
    if (std::ranges::any_of(judged, &HeldValue::is_missed)) return false;
    return std::nullopt;
}

/// Adds the unit to a text of one value, or of two ends where both are bounded.
std::string with_unit(std::string text, const Number& number)
{
    if (!number.unit.empty()) text += fmt::format(" {}", number.unit);
    return number.name.empty() ? text : fmt::format("{}: {}", number.name, text);
}

/// Returns the judged values of a number as a text.
std::string said(const Number& number)
{
    const auto judged = held_values(number);
    if (judged.empty()) return with_unit("not measured", number);
    if (judged.size() == 1) return with_unit(fmt::format("{:.3g}", judged[0].value), number);
    return with_unit(fmt::format("{:.3g} to {:.3g}", judged[0].value, judged[1].value), number);
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

// The measures of the claims.

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

/// Returns the bound of the energy, in millijoules: the energy that a copy lends, stores in its
/// contacts and in the cube's motion, and gives in a tick. Each further copy adds the energy that
/// it stores. docs/design/remote-proxy.md derives the bound.
double energy_bound_mj(const experiment::ClaimCell& cell)
{
    const peer::RemoteProxyOptions proxy;
    constexpr double age_max_s = 0.4;
    constexpr double burst_s = 0.1; // the longest gap of a burst; with loss it is age_max_s
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
        return {std::move(claims_), std::move(quantiles_), std::move(numbers_)};
    }

private:
    using Cells = std::vector<std::string_view>;

    /// Returns a number of the first algorithm, in these conditions and tasks.
    [[nodiscard]] Number
    number(std::string name, const Cells& cells, const Tasks& tasks,
           const std::function<std::optional<double>(const ClaimSession&)>& measure) const
    {
        Number found{.name = std::move(name)};
        for (const ClaimSession& session : sessions_.sessions) {
            if (session.algorithm != experiment_.algorithms.front().name) continue;
            if (std::ranges::find(cells, session.cell->name) == cells.end()) continue;
            if (std::ranges::find(tasks, session.task) == tasks.end()) continue;
            if (const auto value = measure(session)) found.values.push_back(*value);
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
    /// Returns the share of usable sessions, which must be nine of ten.
    [[nodiscard]] Number usable(std::string name, const Cells& cells) const
    {
        const Measure is_usable = [this](const metrics::Scores& scores) {
            return std::optional{judge(scores, criteria_).tier == metrics::Tier::unusable ? 0.0
                                                                                          : 100.0};
        };
        Number found = of(std::move(name), cells, pressed, is_usable,
                          {.least = 100.0 * kept_share, .by = JudgedBy::mean}, "% usable");
        return found;
    }
    void add(std::string_view claim, const std::vector<Number>& numbers)
    {
        quantiles_.add(claim, joined(numbers, said), experiment_.seeds);
        const auto is = [](std::optional<bool> wanted) {
            return [wanted](const Number& number) { return is_kept(number) == wanted; };
        };
        const std::string_view verdict = std::ranges::all_of(numbers, is(true))    ? "met"
                                         : std::ranges::any_of(numbers, is(false)) ? "missed"
                                                                                   : "undecided";
        claims_.add(claim, joined(numbers, said), joined(numbers, accepted), verdict);
        for (const Number& one : numbers) add_number(claim, one);
    }
    void add_number(std::string_view claim, const Number& number)
    {
        const auto judged = held_values(number);
        const auto worst = std::ranges::max_element(judged, {}, &HeldValue::shortfall);
        const auto if_any = [&](double value) {
            return worst == judged.end() || !std::isfinite(value) ? std::nullopt
                                                                  : std::optional{value};
        };
        const HeldValue shown = worst == judged.end() ? HeldValue{} : *worst;
        numbers_.add(claim, number.name, if_any(shown.value), if_any(shown.interval.low),
                     if_any(shown.interval.high), number.wanted.least, number.wanted.most,
                     number.unit, number.wanted.by, number.values.size(), is_kept(number),
                     experiment_.seeds,
                     std::get<experiment::Claims>(experiment_.kind).judging_seeds);
    }

    void claim_usable()
    {
        add("bears 300 ms of delay", {usable("100 ms", {"100ms"}), usable("160 ms", {"160ms"}),
                                      usable("200 ms", {"200ms"}), usable("300 ms", {"300ms"})});
        add("bears 30 ms of jitter", {usable("", {"jitter-30ms"})});
        add("bears 97 % loss and bursts of 90",
            {usable("97 %", {"loss-97"}), usable("90 of 100", {"burst-90"})});
        // The vibration is only reported; the first number alone is judged.
        add("bears 200 ms and 30 ms of jitter and 97 % loss at once",
            {usable("", {"all"}),
             of("vibration", {"all"}, pressed, vibration_mm,
                {.most = criteria_.usable.vibration_max_m.first * 1e3}, "mm")});
    }
    void claim_stiffness()
    {
        const Tasks press{Task::t2};
        constexpr Wanted each{.least = 0.75, .most = 1.25};
        constexpr Wanted mean{.least = 0.85, .most = 1.15, .by = JudgedBy::mean};
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
            return of(std::move(name), {cell}, {task}, mean_mm,
                      {.most = most, .by = JudgedBy::mean}, "mm");
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
        margin.wanted = {.least = 0.0, .by = JudgedBy::each}; // the bound holds for every session
        margin.unit = "mJ";
        add("energy of all hands above its bound, by", {margin});
    }
    void claim_three()
    {
        const auto ratio = [&](std::string name, std::string_view of_three,
                               std::string_view of_two) {
            Number worst{.name = std::move(name),
                         .wanted = {.most = 1.3, .by = JudgedBy::each},
                         .unit = "x of two"};
            for (const Task task : pressed) {
                const Number three = of("", {of_three}, {task}, mean_mm, {});
                const Number two = of("", {of_two}, {task}, mean_mm, {});
                if (three.values.empty() || two.values.empty()) continue;
                worst.values.push_back(mean_of(three.values) / mean_of(two.values));
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
        for (const double metres : sessions_.silence_m) apart.values.push_back(1e3 * metres);
        add("copies apart a second after silence on a healed network", {apart});
    }

    const experiment::Experiment& experiment_;
    const metrics::Criteria& criteria_;
    const ClaimSessions& sessions_;
    Table claims_{"claims", columns_in("claim,value,accept,verdict")};
    Table quantiles_{"claims_quantiles", columns_in("claim,quantile,seeds")};
    Table numbers_{"claims_numbers",
                   columns_in("claim,number,value:4,low:4,high:4,accept_low,accept_high,unit,"
                              "judged_by,sessions,kept,seeds,seeds_needed")};
};

using Stiffness = decltype(metrics::Metrics::stiffness_n_per_m);

/// Returns the stiffness that each side feels in one shared world, the median of the seeds. In a
/// single session a hand that resists the press is held by the friction of its device, or slips as
/// it wavers.
Stiffness usual_stiffness(std::span<const experiment::JobResult> of_seeds,
                          Stiffness metrics::Metrics::*part)
{
    Stiffness usual{};
    for (std::size_t press = 0; press < usual.size(); ++press) {
        for (std::size_t side = 0; side < usual[press].size(); ++side) {
            std::vector<double> felt;
            for (const experiment::JobResult& result : of_seeds) {
                const auto& one = std::get<experiment::SessionResult>(result);
                if (const auto value = (one.reference.*part)[press][side]) felt.push_back(*value);
            }
            if (!felt.empty()) usual[press][side] = metrics::quantile_of(felt, 0.5);
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
                const auto storage =
                    usual_stiffness(of_seeds, &metrics::Metrics::stiffness_n_per_m);
                const auto loss =
                    usual_stiffness(of_seeds, &metrics::Metrics::loss_stiffness_n_per_m);
                for (std::uint32_t seed = 0; seed < experiment.seeds; ++seed) {
                    const auto& one = std::get<experiment::SessionResult>(of_seeds[seed]);
                    metrics::Metrics reference = one.reference;
                    reference.stiffness_n_per_m = storage;
                    reference.loss_stiffness_n_per_m = loss;
                    found.sessions.push_back({&cell, algorithm.name, task,
                                              experiment.first_seed + seed,
                                              scores_of(one.metrics, reference)});
                }
                next += experiment.seeds;
            }
        }
    }
    for (std::uint32_t seed = 0; seed < experiment.seeds; ++seed) {
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
                           "contact_lost:4,energy_mj:4,scored_share:4,tier,stiffness_error:4?,"
                           "slow_stiffness_error:4?")};
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
                  judge(scores, criteria).tier, scores.stiffness_error,
                  scores.slow_stiffness_error);
    }
    return table;
}

} // namespace hapnet::lab::results
