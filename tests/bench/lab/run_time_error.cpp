// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/lab/run_time_error.hpp"

#include "tests/bench/lab/sessions.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

using device::Task;
using namespace std::chrono_literals;

constexpr base::Duration reference_tick = 50us;
constexpr std::array<base::Duration, 5> ticks{4ms, 2ms, 1ms, 500us, 250us};
constexpr std::array steps_in_a_tick{1, 2, 5, 20, 100};
constexpr std::array seeds_taken{1, 2, 5, 10, 20};
constexpr std::size_t groups_min = 5; // groups of seeds: fewer say little
constexpr std::array<std::string_view, 3> algorithms{"base", "dead-reckoning", "sep"};
constexpr std::array<std::string_view, 3> figures{"mean", "std", "max"};

double figure(const Figures& of, std::string_view name)
{
    if (name == "mean") return of.mean;
    return name == "std" ? of.std : of.max;
}

/// Plays a session several times, and returns its result with the least wall time.
Result played_often(const Session& session, int times)
{
    Result best = played(session);
    for (int i = 1; i < times; ++i) {
        Result again = played(session);
        best.wall_s = std::min(best.wall_s, again.wall_s);
    }
    return best;
}

/// P1 with one algorithm, and with other ticks and hands.
class P1 {
public:
    P1(std::string_view algorithm, bool quick)
        : algorithm_{algorithm},
          times_{quick ? 2 : 5},
          reference_{figures_of(played(session(reference_tick, 0)).trace)}
    {}

    void add(std::vector<WorkPoint>& points, base::Duration tick, int steps) const
    {
        const Result result = played_often(session(tick, steps), times_);
        const Figures found = figures_of(result.trace);
        for (const std::string_view name : figures) {
            const double right = figure(reference_, name);
            points.push_back({.varied = steps == 0 ? "tick" : "steps",
                              .task = "P1",
                              .algorithm = algorithm_,
                              .figure = name,
                              .tick_ms = 1e3 * base::to_seconds(tick),
                              .steps = steps,
                              .wall_s = result.wall_s,
                              .error_mm = std::abs(figure(found, name) - right),
                              .reference_mm = right});
        }
    }

private:
    [[nodiscard]] Session session(base::Duration tick, int steps) const
    {
        Session session = session_of(Task::p1, algorithm_);
        session.setting.tick = tick;
        session.steps_a_read = steps;
        return session;
    }

    std::string algorithm_;
    int times_;
    Figures reference_;
};

double mean_of(const std::vector<double>& values, std::size_t from, std::size_t count)
{
    double sum = 0.0;
    for (std::size_t i = from; i < from + count; ++i) sum += values[i];
    return sum / static_cast<double>(count);
}

/// Estimates the error of a mean of `count` values from groups of that size. The mean of all values
/// contains each group, so distances from it are too small.
double group_error(const std::vector<double>& values, std::size_t count)
{
    const double all = mean_of(values, 0, values.size());
    const double part = static_cast<double>(count) / static_cast<double>(values.size());
    double squares = 0.0;
    const std::size_t groups = values.size() / count;
    for (std::size_t group = 0; group < groups; ++group) {
        const double error = mean_of(values, group * count, count) - all;
        squares += error * error;
    }
    return std::sqrt(squares / static_cast<double>(groups) / (1.0 - part));
}

void add_seeds_of_t3(std::vector<WorkPoint>& points, bool quick)
{
    const std::size_t pool = quick ? 60 : 200;
    std::array<std::vector<double>, figures.size()> values;
    double wall_s = 0.0;
    for (std::size_t seed = 1; seed <= pool; ++seed) {
        Session session = session_of(Task::t3, "base");
        session.setting.seed = base::Seed{seed};
        const Result result = played(session);
        wall_s += result.wall_s / static_cast<double>(pool);
        const Figures found = figures_of(result.trace);
        for (std::size_t i = 0; i < figures.size(); ++i) {
            values.at(i).push_back(figure(found, figures.at(i)));
        }
    }
    for (std::size_t i = 0; i < figures.size(); ++i) {
        for (const int seeds : seeds_taken) {
            if (pool / static_cast<std::size_t>(seeds) < groups_min) continue;
            points.push_back(
                {.varied = "seeds",
                 .task = "T3",
                 .algorithm = "base",
                 .figure = figures.at(i),
                 .seeds = seeds,
                 .wall_s = seeds * wall_s,
                 .error_mm = group_error(values.at(i), static_cast<std::size_t>(seeds)),
                 .reference_mm = mean_of(values.at(i), 0, pool)});
        }
    }
}

} // namespace

std::vector<WorkPoint> measure_run_time_error(bool quick)
{
    std::vector<WorkPoint> points;
    for (const std::string_view algorithm : algorithms) {
        const P1 p1{algorithm, quick};
        for (const base::Duration tick : ticks) p1.add(points, tick, 0);
        for (const int steps : steps_in_a_tick) p1.add(points, 1ms, steps);
    }
    add_seeds_of_t3(points, quick);
    return points;
}

std::string work_csv(const std::vector<WorkPoint>& points)
{
    std::string csv =
        "varied,task,algorithm,figure,tick_ms,steps,seeds,wall_s,error_mm,reference_mm\n";
    for (const WorkPoint& point : points) {
        csv += fmt::format("{},{},{},{},{},{},{},{:.6g},{:.6g},{:.6g}\n", point.varied, point.task,
                           point.algorithm, point.figure, point.tick_ms, point.steps, point.seeds,
                           point.wall_s, point.error_mm, point.reference_mm);
    }
    return csv;
}

std::vector<Row> work_rows(const std::vector<WorkPoint>& points)
{
    constexpr int usual_seeds = 10;
    std::vector<Row> rows;
    for (const WorkPoint& point : points) {
        const bool is_usual = point.varied == "seeds"
                                  ? point.seeds == usual_seeds
                                  : point.varied == "tick" && point.tick_ms == 1.0;
        if (!is_usual) continue;
        const bool by_seeds = point.varied == "seeds";
        rows.push_back({.name = fmt::format("{}, {}, 160 ms, {}", point.task, point.algorithm,
                                            by_seeds ? "10 seeds" : "tick of 1 ms"),
                        .subject = "hapnet-lab",
                        .baseline = "",
                        .metric = fmt::format("{}_error_percent", point.figure),
                        .value = point.error_percent(),
                        .baseline_value = std::nullopt,
                        .target = std::nullopt});
    }
    return rows;
}

} // namespace hapnet::bench
