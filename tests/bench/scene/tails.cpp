// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/tails.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

namespace hapnet::bench {

namespace {

double ns_on(clockid_t clock)
{
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) * 1e9 + static_cast<double>(time.tv_nsec);
}

/// One run of a course, and the least time of each step so far.
void time_run(const Course& course, const Contender& contender, std::vector<double>& least)
{
    const auto engine = contender.subject->make(course.scene, contender.options);
    if (!engine) return;
    const double step_s = contender.options.tick_s;
    const auto steps = static_cast<std::size_t>(std::llround(course.duration_s / step_s));
    const std::uint32_t hands = course.hands ? course.scene.hands.count : 0;
    std::vector<scene::HandInput> inputs(hands);
    least.resize(steps, std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < steps; ++i) {
        for (std::uint32_t hand = 0; hand < hands; ++hand) {
            inputs[hand] = course.hands(hand, static_cast<double>(i) * step_s);
        }
        const double thread_start = ns_on(CLOCK_THREAD_CPUTIME_ID);
        const double wall_start = ns_on(CLOCK_MONOTONIC);
        for (std::uint32_t hand = 0; hand < hands; ++hand) engine->set_hand(hand, inputs[hand]);
        engine->step();
        const double wall = ns_on(CLOCK_MONOTONIC) - wall_start;
        const double thread = ns_on(CLOCK_THREAD_CPUTIME_ID) - thread_start;
        least[i] = std::min({least[i], wall, thread});
    }
}

} // namespace

std::vector<std::vector<double>> least_times(const Course& course,
                                             std::span<const Contender> contenders, int runs)
{
    std::vector<std::vector<double>> least(contenders.size());
    for (int run = 0; run < runs; ++run) {
        for (std::size_t i = 0; i < contenders.size(); ++i) {
            time_run(course, contenders[i], least[i]);
        }
    }
    return least;
}

double quantile(std::vector<double> values, double share)
{
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto last = static_cast<double>(values.size() - 1);
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::ceil(share * last));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

std::vector<Row> tails_of(const Course& course, std::span<const Entry> entries,
                          const Question& question, int runs)
{
    std::vector<Contender> contenders;
    for (const Entry& one : entries) contenders.push_back({one.subject, one.options});
    const auto times = least_times(course, contenders, runs);
    std::vector<Row> rows;
    const auto add = [&](const char* metric, double share, std::optional<double> target) {
        std::vector<Reading> readings;
        for (std::size_t i = 0; i < entries.size(); ++i) {
            if (times[i].empty()) continue;
            readings.push_back(
                {entries[i].name, entries[i].subject->family, quantile(times[i], share)});
        }
        append(rows, compare({question.name, question.reference, metric, target}, readings));
    };
    add("p50_ns", 0.5, {});
    add("p99_ns", 0.99, {});
    add("worst_ns", 1.0, question.target);
    return rows;
}

} // namespace hapnet::bench
