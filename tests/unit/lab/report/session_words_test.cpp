// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/session_words.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::report {
namespace {

using namespace std::chrono_literals;
using results::RecordedSession;

RecordedSession session_of_daemons()
{
    const nlohmann::json config{{"program", "hapnet-peer"},
                                {"task", "T3"},
                                {"scene", "paper"},
                                {"algorithm", "base"},
                                {"seed", 7},
                                {"boot_id", "0c2e"},
                                {"device", "simulated Omni"},
                                {"operator", "nominal"}};
    RecordedSession session;
    session.task = "T3";
    session.algorithm = "base";
    session.length = 12500ms;
    session.a = {1, config, "a.rec"};
    session.b = {2, config, "her b.rec"};
    return session;
}

TEST(SessionWords, SayWhatWasPlayedInOneSentence)
{
    auto session = session_of_daemons();
    EXPECT_EQ(sentence_of(session),
              "Two simulated hands, A (peer 1) and B (peer 2), played task T3 in the scene paper "
              "for 12.5 s with the algorithm base.");
    session.b.config["device"] = "Novint Falcon";
    session.b.config["operator"] = nullptr;
    EXPECT_EQ(sentence_of(session),
              "A (peer 1, a simulated hand) and B (peer 2, Novint Falcon) played task T3 in the "
              "scene paper for 12.5 s with the algorithm base.");
    session.a.config["device"] = "replay";
    session.a.config.erase("operator");
    session.a.config["boot_id"] = "virtual time";
    EXPECT_EQ(sentence_of(session).substr(0, 29), "A (peer 1, a recorded hand) a");
    EXPECT_TRUE(sentence_of(session).ends_with(", in virtual time."));
}

TEST(SessionWords, SayNoMoreThanARecordDoes)
{
    RecordedSession session;
    session.a.id = 3;
    session.b.id = 5;
    session.length = 2s;
    EXPECT_EQ(sentence_of(session), "Peers 3 (A) and 5 (B) played for 2 s.");
    EXPECT_EQ(settings_table(session).rows.size(), 1U) << "the ids";
}

TEST(SessionWords, SayWhatWasAskedOfTheNetworkOrWhichFileHasIt)
{
    auto session = session_of_daemons();
    EXPECT_TRUE(about_network(session).ends_with("hapnet-emulator report RUN.json --out run.html "
                                                 "draws what was asked and what came of it."));
    EXPECT_FALSE(is_virtual(session));
    session.a.config["boot_id"] = "virtual time";
    EXPECT_TRUE(is_virtual(session));
    EXPECT_TRUE(about_network(session).ends_with("the manifest.json of the experiment has it."));
    session.a.config["network_toml"] = "[both]\ndelay = \"100ms\"\njitter = \"5ms\"\n";
    EXPECT_EQ(about_network(session), "Asked of the network: delay 100 ms, jitter 5 ms.");
    session.a.config["network_toml"] =
        "[up]\ndelay = \"1ms\"\n[[at]]\ntime = \"3s\"\nup.delay = \"9ms\"\n";
    EXPECT_EQ(about_network(session),
              "Asked of the network: A to B: delay 1 ms at the start, and other conditions later.");
    session.a.config["network_toml"] = "name = \"no conditions\"\n";
    EXPECT_EQ(about_network(session), "Asked of the network: nothing, it is perfect.");
}

TEST(SessionWords, SayWhatIsAssumedOfTheClocks)
{
    auto session = session_of_daemons();
    EXPECT_EQ(about_clocks(session),
              "Both peers ran on one machine, so both stamps of a message are of one clock.");
    session.analysis.clock = {.method = records::ClockMethod::echo,
                              .offset = 7250us,
                              .uncertainty = 1500us,
                              .skew = 12.5e-6};
    const auto text = about_clocks(session);
    EXPECT_TRUE(text.starts_with("Two clocks: B’s was 7.250 ms ahead of A’s, and ran 12.5 ppm "));
    EXPECT_NE(text.find("as if the shortest delays of both directions were equal"),
              std::string::npos);
    EXPECT_NE(text.find("wrong by up to 1.500 ms"), std::string::npos);
    session.a.config["boot_id"] = "virtual time";
    EXPECT_TRUE(about_clocks(session).ends_with("the delays are exact, and no tick is late."));
}

TEST(SessionWords, GiveTheCommandsThatHaveTheSessionAgain)
{
    auto session = session_of_daemons();
    const auto repeats = repeats_of(session);
    ASSERT_EQ(repeats.size(), 3U);
    EXPECT_EQ(repeats[0].commands[0], "hapnet-lab analyse a.rec 'her b.rec'");
    EXPECT_EQ(repeats[1].commands[0], "hapnet-lab replay a.rec");
    EXPECT_EQ(repeats[2].commands[0],
              "hapnet-peer --id 1 --remote HOST:PORT --task T3 --scene paper --algorithm base "
              "--seed 7 --operator nominal \\\n    --duration 12.5s --record a.rec");
    session.a.config["peers"] = {2, 3};
    EXPECT_TRUE(repeats_of(session)[2].commands[0].starts_with(
        "hapnet-peer --id 1 --peer 2=HOST:PORT --peer 3=HOST:PORT --task T3"));
    session.a.config["boot_id"] = "virtual time";
    EXPECT_TRUE(repeats_of(session)[2].commands.empty()) << "no peer played it";
}

TEST(SessionWords, PutTheSettingsOfBothBesideEachOther)
{
    auto session = session_of_daemons();
    session.b.config.erase("seed");
    const auto table = settings_table(session);
    EXPECT_EQ(table.heads, (std::vector<std::string>{"A", "B"}));
    const auto row = [&](std::string_view name) {
        const auto found = std::ranges::find(table.rows, name, &records::TextTable::Row::name);
        return found == table.rows.end() ? std::vector<std::string>{} : found->cells;
    };
    EXPECT_EQ(row("record"), (std::vector<std::string>{"a.rec", "her b.rec"}));
    EXPECT_EQ(row("seed"), (std::vector<std::string>{"7", "–"}));
    EXPECT_TRUE(row("force limit, N").empty()) << "neither says it";
}

} // namespace
} // namespace hapnet::lab::report
