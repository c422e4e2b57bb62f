// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/lab/speed.hpp"

#include "tests/bench/lab/sessions.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

using device::Task;

constexpr double target_of_p1 = 1000.0; // the carried cube, with a hand without tremor
constexpr double target_of_others = 300.0;
constexpr int steps_before = 20; // steps per millisecond of the reference

struct Case {
    Session session;
    std::string_view algorithm;
    std::vector<double> wall_s_per_s{}; // one value per round

    [[nodiscard]] Row row() const
    {
        std::vector<double> sorted = wall_s_per_s;
        std::sort(sorted.begin(), sorted.end());
        const bool is_ours = session.steps_a_read == 0;
        const bool is_p1 = session.setting.task == Task::p1;
        Row row{.name = fmt::format("{}, {}, 160 ms", name_of(session.setting.task), algorithm),
                .subject = is_ours ? "hapnet-lab" : "hands in twenty steps",
                .baseline = "real-time",
                .metric = "speed_ratio",
                .value = sorted[sorted.size() / 2],
                .baseline_value = 1.0,
                .target = std::nullopt,
                .direction = Direction::at_least};
        if (is_ours) row.target = is_p1 ? target_of_p1 : target_of_others;
        return row;
    }
};

std::vector<Case> cases()
{
    std::vector<Case> cases;
    for (const Task task : {Task::p1, Task::t1, Task::t2, Task::t3, Task::t4, Task::t5, Task::t6}) {
        cases.push_back({session_of(task, "base"), "base"});
    }
    for (const Task task : {Task::p1, Task::t3}) {
        for (const std::string_view algorithm : {"dead-reckoning", "sep"}) {
            cases.push_back({session_of(task, algorithm), algorithm});
        }
        Case before{session_of(task, "base"), "base"};
        before.session.steps_a_read = steps_before;
        cases.push_back(std::move(before));
    }
    return cases;
}

} // namespace

std::vector<Row> measure_speed(int rounds)
{
    std::vector<Case> all = cases();
    for (int round = 0; round < rounds; ++round) {
        for (Case& one : all) one.wall_s_per_s.push_back(played(one.session).wall_s_per_s());
    }
    std::vector<Row> rows;
    for (const Case& one : all) rows.push_back(one.row());
    return rows;
}

} // namespace hapnet::bench
