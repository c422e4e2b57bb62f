// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/json.hpp"
#include "tests/unit/lab/metrics/made_traces.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace hapnet::lab::metrics {
namespace {

using device::Task;

TEST(MetricsJson, ReadsBackExactly)
{
    Metrics metrics = metrics_of(pressing(123.456789, 80.1));
    metrics.task = Task::t6;
    metrics.drops = 1.0;
    metrics.response_s = 0.1 + 0.2;
    metrics.body_vibration_m[0] = ByOrder{.first = 1.0 / 3.0, .second = 5e-324, .fourth = 1.7e308};
    metrics.body_vibration_m[1].reset();
    for (const Metrics& written : {metrics, Metrics{}}) {
        const auto read = metrics_from(nlohmann::json::parse(to_json(written).dump()));
        ASSERT_TRUE(read);
        EXPECT_EQ(*read, written);
    }
}

TEST(MetricsJson, RefusesWhatIsSomethingElse)
{
    const nlohmann::json good = nlohmann::json::parse(to_json(Metrics{}).dump());
    ASSERT_TRUE(metrics_from(good));
    for (const auto& [key, value] : good.items()) {
        nlohmann::json wrong = good;
        wrong.erase(key);
        EXPECT_FALSE(metrics_from(wrong)) << key;
        wrong[key] = "P0";
        EXPECT_FALSE(metrics_from(wrong)) << key;
    }
    EXPECT_FALSE(metrics_from(nlohmann::json::array()));
}

} // namespace
} // namespace hapnet::lab::metrics
