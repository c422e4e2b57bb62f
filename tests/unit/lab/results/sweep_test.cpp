// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/sweep.hpp"

#include "lab/experiment/daemons.hpp"
#include "lab/experiment/text.hpp"
#include "lab/results/table_text.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::results {
namespace {

/// Two seeds of one condition.
experiment::Experiment two_seeds()
{
    return experiment::parse_experiment(
               "title = \"a\"\nkind = \"plane\"\nseeds = 2\nfirst_seed = 1\n"
               "duration = \"5s\"\nalgorithms = [\"base\"]\n"
               "tasks = [\"T1\"]\nplane.delay = \"5ms\"\n"
               "plane.jitter = \"0ms\"\nplane.loss = \"0%\"\n",
               "a")
        .value();
}

/// `real_mm` apart in real time, 2 mm apart in virtual time.
PlayedCell played(double real_mm)
{
    PlayedCell cell;
    cell.real.task = cell.simulated.task = cell.perfect.task = device::Task::t1;
    cell.real.scored_s = cell.simulated.scored_s = cell.perfect.scored_s = 2.0;
    cell.real.discrepancy_m = metrics::Spread{1e-3 * real_mm, 0.0, 0.01, 1e-3};
    cell.simulated.discrepancy_m = metrics::Spread{2e-3, 0.0, 0.01, 1e-3};
    return cell;
}

class Swept : public ::testing::Test {
protected:
    SweepRow row(std::size_t session, const PlayedCell& cell, std::uint32_t attempt = 1)
    {
        auto row = make_sweep_row({experiment_, sessions_.at(session)}, cell, {});
        row.attempt = attempt;
        return row;
    }
    static ConditionRow mean_of(const std::vector<SweepRow>& rows)
    {
        const auto conditions = make_condition_rows(rows);
        EXPECT_EQ(conditions.front().measure, "mean_mm");
        return conditions.front();
    }

    experiment::Experiment experiment_ = two_seeds();
    std::vector<experiment::SessionJob> sessions_ = daemon_sessions(experiment_).value();
};

TEST_F(Swept, ConditionIsTheMeanOfItsValidSessions)
{
    const auto mean = mean_of({row(0, played(2.2)), row(1, played(2.0))});
    EXPECT_EQ(mean.sessions, 2U);
    EXPECT_NEAR(mean.real.value(), 2.1, 1e-9);
    EXPECT_NEAR(mean.simulated.value(), 2.0, 1e-9);
    EXPECT_NEAR(mean.difference_percent.value(), 5.0, 1e-9);
    EXPECT_TRUE(mean.ci_low_percent && mean.ci_high_percent);
}

TEST_F(Swept, SessionThatIsNotValidIsMarkedAndLeftOut)
{
    PlayedCell late = played(9.0);
    late.invalid_because = {"peer 2: late", "and late again"};
    const std::vector<SweepRow> rows{row(0, late), row(1, played(2.0))};
    const auto mean = mean_of(rows);
    EXPECT_EQ(mean.sessions, 1U);
    EXPECT_EQ(mean.left_out, 1U);
    EXPECT_NEAR(mean.real.value(), 2.0, 1e-9);
    const auto csv = csv_text(sweep_table(rows));
    EXPECT_NE(csv.find(",,,0,0.0,false,peer 2: late; and late again\n"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",0.00,,0,0.0,true,\n"), std::string::npos) << csv;
}

TEST_F(Swept, AttemptThatIsValidCountsInsteadOfTheOneBefore)
{
    PlayedCell late = played(9.0);
    late.invalid_because = {"peer 2: late"};
    const auto mean = mean_of({row(0, late), row(0, played(2.2), 2)});
    EXPECT_EQ(mean.sessions, 1U);
    EXPECT_EQ(mean.left_out, 0U);
    EXPECT_NEAR(mean.real.value(), 2.2, 1e-9);
}

TEST_F(Swept, ResultReadsBackAsItWas)
{
    PlayedCell cell = played(2.5);
    cell.missed_ticks = 7;
    cell.longest_gap_ms = 13.5;
    cell.invalid_because = {"late"};
    const auto back = played_cell_from(nlohmann::json::parse(to_json(cell).dump()));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->real, cell.real);
    EXPECT_EQ(back->missed_ticks, 7U);
    EXPECT_EQ(back->longest_gap_ms, 13.5);
    EXPECT_EQ(back->invalid_because, cell.invalid_because);
    EXPECT_FALSE(played_cell_from(nlohmann::json::object()));
}

TEST(PlayedCell, IsRefusedWithTheKeyThatIsMissingOrHasAnotherType)
{
    PlayedCell cell;
    cell.real.task = cell.simulated.task = cell.perfect.task = device::Task::t3;
    const nlohmann::json whole = to_json(cell);
    const auto refusal = [](const nlohmann::json& json) {
        const auto played = played_cell_from(json);
        return played ? "" : played.error().message;
    };
    ASSERT_EQ(refusal(whole), "");
    for (const char* key : {"real", "virtual", "perfect", "invalid_because"}) {
        auto without = whole;
        without.erase(key);
        EXPECT_NE(refusal(without).find(key), std::string::npos) << key;
    }
    const std::vector<std::pair<const char*, nlohmann::json>> wrong{{"real", 5},
                                                                    {"virtual", "x"},
                                                                    {"perfect", nullptr},
                                                                    {"missed_ticks", -1},
                                                                    {"missed_ticks", 1.5},
                                                                    {"missed_ticks", "7"},
                                                                    {"longest_gap_ms", -1},
                                                                    {"longest_gap_ms", "x"},
                                                                    {"invalid_because", "late"},
                                                                    {"invalid_because", {1}}};
    for (const auto& [key, value] : wrong) {
        auto other = whole;
        other[key] = value;
        EXPECT_NE(refusal(other).find(key), std::string::npos) << key << " " << value;
    }
}

} // namespace
} // namespace hapnet::lab::results
