// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/lab/run_time_error.hpp"
#include "tests/bench/lab/sessions.hpp"

#include <gtest/gtest.h>

namespace hapnet::bench {
namespace {

using namespace std::chrono_literals;

Session short_session()
{
    Session session = session_of(device::Task::p1, "base");
    session.setting.length = 8s;
    return session;
}

TEST(SteppedHand, ComesToTheFiguresOfTheExactOneWithSmallSteps)
{
    const Figures exact = figures_of(played(short_session()).trace);
    EXPECT_GT(exact.mean, 5.0);
    Session session = short_session();
    session.steps_a_read = 100;
    // The stepped hand aims at its place at the end of the tick, and reports counts of 0.055 mm.
    EXPECT_NEAR(figures_of(played(session).trace).mean, exact.mean, 0.02);
}

TEST(Sessions, OfEveryTaskCanBePlayed)
{
    for (const device::Task task : device::all_tasks) {
        Session session = session_of(task, "base");
        session.setting.length = 8s;
        EXPECT_NEAR(played(session).trace.overlap, 1.0, 0.01) << name_of(task);
    }
}

TEST(WorkPoints, AreALineEach)
{
    WorkPoint point{.varied = "tick", .task = "P1", .algorithm = "base", .figure = "mean"};
    point.wall_s = 0.5;
    point.error_mm = 0.25;
    point.reference_mm = 12.5;
    EXPECT_EQ(point.error_percent(), 2.0);
    EXPECT_EQ(work_csv({point}),
              "varied,task,algorithm,figure,tick_ms,steps,seeds,wall_s,error_mm,reference_mm\n"
              "tick,P1,base,mean,1,0,1,0.5,0.25,12.5\n");
}

} // namespace
} // namespace hapnet::bench
