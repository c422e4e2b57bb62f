// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/telemetry/decimator.hpp"

#include "proto/base/fields_json.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hapnet::telemetry {
namespace {

Decimator decimator()
{
    return Decimator{1,
                     {[](std::uint8_t) -> std::string_view { return "active"; },
                      [](std::uint8_t) -> std::string_view { return "none"; }}};
}

record::TickRow row(int tick)
{
    record::TickRow row;
    row.tick = static_cast<std::uint64_t>(tick);
    row.due = base::TimePoint{} + std::chrono::milliseconds{tick};
    row.late = std::chrono::microseconds{(tick * 37) % 101};
    row.missed_before = tick % 10 == 3 ? 1U : 0U;
    row.cube.value = {0.01 * std::sin(tick * 0.7), 0.0, 0.0};
    row.device.value = {std::cos(tick * 1.3), 0.0, 0.0};
    return row;
}

TEST(Decimator, KeepsTheExtremesOfItsRows)
{
    Decimator few = decimator();
    EXPECT_FALSE(few.next());
    int tick = 0;
    for (const int rows : {16, 1, 17, 100}) {
        double least = 1e9;
        double most = -1e9;
        double force = 0.0;
        double late = 0.0;
        std::uint64_t missed = 0;
        for (int i = 0; i < rows; ++i, ++tick) {
            const record::TickRow one = row(tick);
            few.take(one);
            least = std::min(least, one.cube.value.x);
            most = std::max(most, one.cube.value.x);
            force = std::max(force, std::abs(one.device.value.x));
            late = std::max(late, base::to_seconds(one.late) * 1e6);
            missed += one.missed_before;
        }
        const auto frame = few.next();
        ASSERT_TRUE(frame);
        EXPECT_EQ(frame->cube_x_m.min(), least);
        EXPECT_EQ(frame->cube_x_m.max(), most);
        EXPECT_DOUBLE_EQ(frame->force_n.max(), force);
        EXPECT_EQ(frame->late_us.max(), late);
        EXPECT_EQ(frame->late_us.count(), static_cast<std::uint64_t>(rows));
        EXPECT_EQ(frame->missed, missed);
        EXPECT_EQ(frame->newest.row.tick, static_cast<std::uint64_t>(tick - 1));
    }
}

TEST(Frame, IsToldByItsDescription)
{
    Decimator few = decimator();
    few.take(row(7));
    const auto json = base::json_of(*few.next(3));
    EXPECT_EQ(json["frame"], 0);
    EXPECT_EQ(json["peer"], 1);
    EXPECT_EQ(json["tick"], 7);
    EXPECT_EQ(json["ticks"], 1);
    EXPECT_EQ(json["left_out"], 3);
    EXPECT_TRUE(json["session"].is_null());
    EXPECT_TRUE(json["fault"].is_null());
    EXPECT_EQ(json["cube"].size(), 3U);
    EXPECT_EQ(json["governor"], "active");
}

} // namespace
} // namespace hapnet::telemetry
