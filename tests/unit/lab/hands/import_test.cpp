// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/import.hpp"

#include "device/replay/hand_trace.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::hands {
namespace {

/// A hand that comes from `from_mm` toward 0 and goes back, in 4 s, with a column of times that
/// begins late.
std::string hand(double from_mm, double begin_s = 0.0, int missing_from = 0, int missing_to = 0)
{
    std::string text = "time_s,x,y,z\n";
    for (int i = 0; i <= 400; ++i) {
        const double x = from_mm * (0.6 + 0.4 * std::cos(0.005 * 3.14159265358979 * i));
        const bool is_seen = i < missing_from || i >= missing_to;
        text +=
            fmt::format("{},{},10,20\n", begin_s + 0.01 * i, is_seen ? fmt::format("{}", x) : "");
    }
    return text;
}

ImportRules rules()
{
    ImportRules rules;
    rules.format.m_per_unit = 1e-3;
    return rules;
}

std::string refusal(const std::vector<TextFile>& files, const ImportRules& rules)
{
    const auto imported = import_hands(files, rules);
    return imported ? "" : imported.error().message;
}

TEST(Import, MakesScriptsThatADeviceReplays)
{
    const std::vector<TextFile> files{{"rec/a 1.csv", hand(-300.0)}, {"rec/b.csv", hand(300.0)}};
    const auto imported = import_hands(files, rules()).value();
    const ImportedTrial& trial = imported.trial;
    EXPECT_EQ(trial.subject, "1");
    EXPECT_EQ(trial.trial, "a-1");
    EXPECT_NEAR(trial.duration_s, 4.0, 1e-9);
    EXPECT_NEAR(trial.rate_hz, 100.0, 1e-6);
    EXPECT_EQ(trial.a.script, "1-a-1-a.csv");
    EXPECT_EQ(trial.b->source, "rec/b.csv");
    ASSERT_EQ(imported.scripts.size(), 2U);
    const auto trace = device::parse_hand_trace(imported.scripts[0].text, "a.csv").value();
    ASSERT_EQ(trace.size(), 4001U);
    EXPECT_EQ(trace[1234].time_s, 1.234);
    EXPECT_NEAR(trace[2000].hip.x(), -0.021, 2e-4); // nearest in the middle
    EXPECT_NE(told(trial).find("scaled by"), std::string::npos);
}

TEST(Import, TakesWhatBothWereSeenInWhereFilesHaveTimes)
{
    const std::vector<TextFile> files{{"a.csv", hand(-300.0)}, {"b.csv", hand(300.0, 0.5)}};
    const auto trial = import_hands(files, rules()).value().trial;
    EXPECT_NEAR(trial.from_s, 0.5, 1e-9);
    EXPECT_NEAR(trial.duration_s, 3.5, 1e-9);
}

TEST(Import, FillsShortGapsAndSaysSo)
{
    const std::vector<TextFile> files{{"a.csv", hand(-300.0, 0.0, 100, 105)}};
    const auto trial = import_hands(files, rules()).value().trial;
    EXPECT_EQ(trial.a.gaps, 1U);
    EXPECT_NEAR(trial.a.longest_gap_ms, 60.0, 1e-6);
    EXPECT_EQ(trial.a.rows, 401U);
    EXPECT_FALSE(trial.b);
}

TEST(Import, RefusesALongGapUnlessItIsAllowedOrLeftOut)
{
    const std::vector<TextFile> files{{"a.csv", hand(-300.0, 0.0, 100, 120)}};
    EXPECT_EQ(refusal(files, rules()),
              "a.csv: line 122: the hand was not seen for 210 ms, from 0.990 s on, and 100 ms are "
              "allowed: take a stretch without that by --from and --to, or allow more by "
              "--longest-gap");
    ImportRules longer = rules();
    longer.longest_gap_s = 0.3;
    EXPECT_EQ(import_hands(files, longer).value().trial.a.gaps, 1U);
    ImportRules later = rules();
    later.from_s = 1.5;
    later.to_s = 3.5;
    const auto trial = import_hands(files, later).value().trial;
    EXPECT_EQ(trial.a.gaps, 0U);
    EXPECT_NEAR(trial.duration_s, 2.0, 1e-9);
}

TEST(Import, SaysWhatIsWrongWithItsRules)
{
    const TextFile a{"a.csv", hand(-300.0)};
    EXPECT_EQ(refusal({a, a, a}, rules()).find("3 files: name one, or one of A and one of B"), 0U);
    ImportRules coarse = rules();
    coarse.smooth_hz = 60.0;
    EXPECT_NE(refusal({a}, coarse).find("100 rows a second hold nothing above 50 Hz"),
              std::string::npos);
    ImportRules named = rules();
    named.subject = "../1";
    EXPECT_EQ(refusal({a}, named), "--subject '../1': a name has letters, digits, - and _ only");
    ImportRules brief = rules();
    brief.to_s = 0.5;
    EXPECT_EQ(refusal({a}, brief).find("a.csv: 0.500 s in which the hand was seen"), 0U);
}

} // namespace
} // namespace hapnet::lab::hands
