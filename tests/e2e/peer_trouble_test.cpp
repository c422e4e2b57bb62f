// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Parts that die while the others continue, and parts that come back.
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/peer.hpp"

#include <chrono>
#include <csignal>
#include <gtest/gtest.h>
#include <string>
#include <thread>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

const std::vector<std::string> long_t3{"--task", "T3", "--duration", "120s"};

/// Waits until a peer has made `ticks` more ticks.
void expect_to_play_on(const std::string& socket, int ticks)
{
    const auto count = [&] { return answer_of(socket, "stats")["tick"]["count"].get<int>(); };
    EXPECT_TRUE(comes_true([&, end = count() + ticks] { return count() >= end; }));
}

/// Peer A, the emulator, peer B, in a session that outlasts every test.
struct Three {
    Three()
    {
        EXPECT_TRUE(a.says("session started"));
        EXPECT_TRUE(b.says("session started"));
        for (const Peer* peer : {&a, &b}) expect_to_push(*peer);
    }

    [[nodiscard]] std::string socket_of(const Peer& peer) const
    {
        return folder.file(&peer == &a ? "a.sock" : "b.sock");
    }
    void expect_to_push(const Peer& peer) const
    {
        EXPECT_TRUE(comes_true(
            [&] { return answer_of(socket_of(peer), "show").value("force_n", 0.0) > 0.1; }));
        expect_to_play_on(socket_of(peer), 500);
    }
    [[nodiscard]] std::vector<std::string> options(const std::string& socket) const
    {
        auto words = long_t3;
        words.insert(words.end(), {"--control", folder.file(socket)});
        return words;
    }

    TemporaryFolder folder;
    Emulator emulator{{"--delay", "20ms"}};
    Peer a{1, free_place(), emulator.a().to_text(), options("a.sock")};
    Peer b{2, free_place(), emulator.b().to_text(), options("b.sock")};
};

/// Expects in a survivor's record an outage with zero force, and play before and after it.
void expect_outage_with_zero_force(Peer& survivor)
{
    survivor.stop();
    double most_before = 0.0;
    double most_during = 0.0;
    int silent = 0;
    int after = 0;
    for (const Tick& tick : ticks_of(survivor.record())) {
        if (tick.phase != "running") continue;
        if (tick.remote_fresh) {
            after += silent > 0 ? 1 : 0;
            most_before = silent > 0 ? most_before : std::max(most_before, tick.force_n);
        } else if (tick.time_s > 0.5 && ++silent > 20) { // beyond a late tick or two at the edge
            most_during = std::max(most_during, tick.force_n);
        }
    }
    EXPECT_GT(most_before, 0.1);
    EXPECT_GT(silent, 300); // ticks: it kept running
    EXPECT_EQ(most_during, 0.0);
    EXPECT_GT(after, 300);
}

} // namespace

TEST(PeerTrouble, APeerThatIsKilledAndStartedAgainJoinsTheOtherThatFeltNothingMeanwhile)
{
    Three three;
    for (const bool kills_a : {true, false}) {
        Peer& dead = kills_a ? three.a : three.b;
        Peer& survivor = kills_a ? three.b : three.a;
        const auto said_before = survivor.process().err().size();
        dead.kill();
        EXPECT_TRUE(survivor.says("silent"));
        expect_to_play_on(three.socket_of(survivor), 500);
        dead.restart();
        EXPECT_TRUE(survivor.says("restarted"));
        EXPECT_TRUE(dead.says("joined the session under way"));
        EXPECT_GT(survivor.process().err().size(), said_before);
        expect_to_play_on(three.socket_of(survivor), 700);
        if (!kills_a) continue;
        expect_outage_with_zero_force(survivor); // B's record has the outage, as B starts again
        EXPECT_TRUE(dead.says("goodbye"));
        survivor.restart();
        EXPECT_TRUE(survivor.says("joined the session under way"));
        expect_to_play_on(three.socket_of(survivor), 1200);
    }
    three.a.stop();
    three.b.stop();
    std::ignore = three.emulator.stop();
}

TEST(PeerTrouble, AnEmulatorThatIsKilledAndStartedAgainLetsTheSameSessionGoOn)
{
    Three three;
    Process& emulator = three.emulator.process();
    emulator.signal(SIGKILL);
    EXPECT_EQ(emulator.wait_exit(5s), 128 + SIGKILL);
    EXPECT_TRUE(three.a.says("silent"));
    EXPECT_TRUE(three.b.says("silent"));
    for (const Peer* peer : {&three.a, &three.b}) expect_to_play_on(three.socket_of(*peer), 500);
    Process again{"hapnet-emulator",
                  {"--listen-a", three.emulator.a().to_text(), "--listen-b",
                   three.emulator.b().to_text(), "--delay", "20ms"}};
    EXPECT_TRUE(again.wait_for_out("ready ", 10s));
    EXPECT_TRUE(three.a.says("heard again"));
    EXPECT_TRUE(three.b.says("heard again"));
    for (const Peer* peer : {&three.a, &three.b}) expect_to_play_on(three.socket_of(*peer), 700);
    expect_outage_with_zero_force(three.a);
    EXPECT_TRUE(three.b.says("goodbye"));
    expect_outage_with_zero_force(three.b);
    EXPECT_EQ(three.b.process().err().find("restarted"), std::string::npos);
}

TEST(PeerTrouble, APeerThatIsToldToStopSaysGoodbyeAndLeavesStatistics)
{
    for (const int stop : {SIGTERM, SIGINT}) {
        const std::string place_a = free_place();
        const std::string place_b = free_place();
        Peer a{1, place_a, place_b, long_t3}; // without an emulator between them
        Peer b{2, place_b, place_a, long_t3};
        EXPECT_TRUE(a.says("session started"));
        EXPECT_TRUE(b.says("session started"));
        a.process().signal(stop);
        EXPECT_EQ(a.process().wait_exit(5s), 0);
        EXPECT_TRUE(b.says("goodbye"));
        EXPECT_EQ(b.process().wait_exit(300ms), std::nullopt) << "it ended with the other";
        b.stop();
        for (Peer* peer : {&a, &b}) {
            const auto statistics = peer->statistics();
            EXPECT_GT(statistics["messages"]["states_sent"], 0);
            EXPECT_GT(statistics["tick"]["count"], 500);
            EXPECT_EQ(statistics["session"]["role"], peer == &a ? "L" : "R");
        }
        const auto ticks = ticks_of(b.record());
        ASSERT_FALSE(ticks.empty());
        EXPECT_EQ(std::count_if(ticks.begin(), ticks.end(),
                                [](const Tick& t) { return t.phase == "alone"; }) > 100,
                  true);
        EXPECT_EQ(ticks.back().force_n, 0.0);
    }
}

TEST(PeerTrouble, APeerThatNobodyAnswersStopsCleanlyToo)
{
    Peer alone{1, free_place(), free_place(), {}};
    std::this_thread::sleep_for(300ms);
    alone.stop();
    EXPECT_EQ(alone.statistics()["session"], nullptr);
    EXPECT_EQ(alone.statistics()["messages"]["states_sent"], 0);
}

} // namespace hapnet::e2e
