// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/claims.hpp"
#include "lab/experiment/text.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::lab::experiment::claims_test {
namespace {

using namespace std::chrono_literals;

Experiment beat(const std::string& setting)
{
    const auto none = [](const std::string& file) { return base::fail(file); };
    return load_experiment("beat", none, {.quick = false, .settings = {setting}}).value();
}

TEST(Claims, PlayEachConditionWithEverySeedAndSilence)
{
    const Experiment experiment = beat("seeds=12");
    std::size_t tasks = 0;
    for (const ClaimCell& cell : claim_cells()) tasks += cell.tasks.size();
    const auto jobs = make_jobs(experiment);
    EXPECT_EQ(jobs.size(), 12 * tasks + 12);
    for (const Job& job : jobs) {
        const auto* const silence = std::get_if<SilenceJob>(&job);
        const SessionSpec& spec =
            silence != nullptr ? silence->spec : std::get<SessionJob>(job).spec;
        EXPECT_TRUE(validate(spec.setting));
        EXPECT_GE(spec.setting.seed.value(), 400001U);
    }
}

TEST(Claims, OfSilenceFindTheCopiesTogetherWhereNothingHadToHeal)
{
    const Experiment experiment = beat("seeds=1");
    const auto jobs = make_jobs(experiment);
    SessionSpec spec = std::get<SilenceJob>(jobs.back()).spec;
    EXPECT_EQ(spec.setting.length, 10s);
    spec.setting.profile = {};
    const auto apart_m = apart_after_silence(spec.setting, 1s);
    ASSERT_TRUE(apart_m);
    EXPECT_LT(*apart_m, 1e-4);
}

} // namespace
} // namespace hapnet::lab::experiment::claims_test
