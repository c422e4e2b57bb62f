// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Two peers that play through the emulator in real time, and their records.
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/peer.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <string>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

/// Plays a session from start to end. Returns the analysis of its two records.
nlohmann::json played(Emulator& emulator, const std::vector<std::string>& options)
{
    Peer a{1, free_place(), emulator.a().to_text(), options};
    Peer b{2, free_place(), emulator.b().to_text(), options};
    a.expect_end();
    b.expect_end();
    for (Peer* peer : {&a, &b}) {
        const auto statistics = peer->statistics();
        EXPECT_EQ(statistics["messages"]["malformed"], 0);
        EXPECT_EQ(statistics["messages"]["strangers"], 0);
        EXPECT_EQ(statistics["governor"]["unusable_samples"], 0);
        EXPECT_EQ(statistics["record_rows_lost"], 0);
        EXPECT_EQ(statistics["refusal"], nullptr);
        expect_the_same_forces_again(peer->record());
    }
    return analysis_of(a.record(), b.record());
}

/// A machine too busy for a haptic loop reports that itself. Then only the rates are not checked.
bool is_valid(const nlohmann::json& analysis)
{
    if (analysis["valid"] == true) return true;
    std::printf("[ NOT VALID ] %s: rates are not checked\n",
                analysis["invalid_because"].dump().c_str());
    return false;
}

} // namespace

TEST(PeerSession, OfT3Under160MsIsPlayedToItsEndAsTheEmulatorWasTold)
{
    Emulator emulator{{"--delay", "160ms"}};
    const auto analysis = played(emulator, {"--task", "T3", "--duration", "8s"});
    const bool valid = is_valid(analysis);
    for (const char* way : {"a_to_b", "b_to_a"}) {
        const auto& path = analysis[way];
        EXPECT_NEAR(path["delay_ms"]["p50"].get<double>(), 160.0, 1.0) << way;
        EXPECT_EQ(path["loss"], 0.0) << way;
        EXPECT_EQ(path["reordered"], 0) << way;
        EXPECT_EQ(path["duplicates"], 0) << way;
        EXPECT_GT(path["sent"], 6000) << way;
        if (valid) {
            EXPECT_NEAR(path["packets_per_s"].get<double>(), 1000.0, 5.0) << way;
        }
    }
    if (valid) {
        EXPECT_GT(analysis["overlap"].get<double>(), 0.95);
    }
    EXPECT_GT(analysis["discrepancy_x_mm"]["mean"].get<double>(), 1.0);
    EXPECT_LE(analysis["settled_discrepancy_mm"].get<double>(), 0.1);
    const auto statistics = emulator.stop();
    EXPECT_GT(statistics["up"]["delivered"], 6000);
}

TEST(PeerSession, UnderALossOf93PercentSeesThatLoss)
{
    Emulator emulator{{"--loss", "93%", "--delay", "20ms", "--seed", "7"}};
    const auto analysis = played(emulator, {"--task", "P1", "--duration", "12s"});
    for (const char* way : {"a_to_b", "b_to_a"}) {
        const auto sent = analysis[way]["sent"].get<double>();
        EXPECT_GT(sent, 4000.0) << way;
        const double standard_error = std::sqrt(0.93 * 0.07 / sent);
        EXPECT_NEAR(analysis[way]["loss"].get<double>(), 0.93, 4.0 * standard_error) << way;
        EXPECT_NEAR(analysis[way]["delay_ms"]["p50"].get<double>(), 20.0, 1.0) << way;
    }
    EXPECT_LE(analysis["settled_discrepancy_mm"].get<double>(), 0.1);
    std::ignore = emulator.stop();
}

} // namespace hapnet::e2e
