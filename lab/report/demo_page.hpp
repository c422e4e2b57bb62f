// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/session.hpp"
#include "lab/report/plot/plot.hpp"
#include "lab/results/demo.hpp"

#include <string>
#include <vector>

namespace hapnet::lab {

/// What a task of the demo looked like over time: every tenth tick of both peers, in seconds
/// from the session's start on A's clock.
struct TaskTrace {
    std::vector<plot::Point> cube_a_mm; // x of each copy of the cube
    std::vector<plot::Point> cube_b_mm;
    std::vector<plot::Point> force_a_n; // what each device was told
    std::vector<plot::Point> force_b_n;
};

[[nodiscard]] TaskTrace task_trace_of(const Session& session);

/// The page that the demo leaves behind: the table, the plots of both tasks and the manifest in
/// one HTML file that needs nothing else.
[[nodiscard]] std::string demo_page(const DemoRun& run, const DemoCircumstances& circumstances,
                                    const TaskTrace& p1, const TaskTrace& t3);

} // namespace hapnet::lab
