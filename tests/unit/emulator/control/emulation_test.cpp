// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/control/core/conversation.hpp"

#include "tests/unit/emulator/control/emulation_fake.hpp"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

const base::TimePoint start{100s};
constexpr const char* toml = "name = \"plain\"\n[both]\ndelay = \"160ms\"\n";

struct Talk : testing::Test {
    /// The one reply to one request.
    json ask(const json& request, base::TimePoint now = start)
    {
        const auto said = said_to(conversation, request.dump() + "\n", fake, now);
        EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
        return json::parse(said, nullptr, false);
    }

    std::string refused(const json& request)
    {
        const auto reply = ask(request);
        EXPECT_EQ(reply["ok"], false) << reply;
        EXPECT_EQ(fake.director().generation(), 1U);
        return reply["error"];
    }

    EmulationFake fake{toml, start};
    Conversation conversation;
};

json set(const json& settings) { return {{"command", "set"}, {"settings", settings}}; }

TEST_F(Talk, AnswersAChangeWithTheTimeTheGenerationAndTheDatagramsFromWhichItHolds)
{
    for (int i = 0; i < 5; ++i) std::ignore = fake.path().on_packet(Direction::up, {}, start);
    for (int i = 0; i < 3; ++i) std::ignore = fake.path().on_packet(Direction::down, {}, start);
    const auto reply = ask(set({{"both.delay", "80ms"}}), start + 1s);
    EXPECT_EQ(reply, (json{{"ok", true},
                           {"generation", 2},
                           {"changed", true},
                           {"elapsed_s", 1.0},
                           {"effective_at_ns", 101'000'000'000},
                           {"effective_at", {{"up", 5}, {"down", 3}}}}));
    EXPECT_EQ(fake.delay(Direction::up), DelayLaw{ConstantLaw{80ms}});
    EXPECT_EQ(fake.delay(Direction::down), DelayLaw{ConstantLaw{80ms}});
}

TEST_F(Talk, SaysThatNothingChanged)
{
    EXPECT_EQ(ask(set({{"both.delay", "80ms"}}))["changed"], true);
    EXPECT_EQ(ask({{"command", "reset"}})["changed"], true);
    EXPECT_EQ(ask({{"command", "reset"}})["changed"], false);
}

TEST_F(Talk, LetsOneWayWinOverBothWaysInOneRequest)
{
    ask(json::parse(R"({"command":"set","settings":{"up.delay":"10ms","both.delay":"20ms"}})"));
    EXPECT_EQ(fake.delay(Direction::up), DelayLaw{ConstantLaw{10ms}});
    EXPECT_EQ(fake.delay(Direction::down), DelayLaw{ConstantLaw{20ms}});
}

TEST_F(Talk, MakesAllSettingsOfARequestOrNone)
{
    const auto error = refused(set({{"both.delay", "80ms"}, {"both.loss", "101%"}}));
    EXPECT_NE(error.find("both.loss"), std::string::npos) << error;
    EXPECT_EQ(fake.director().path().up.delay.law, DelayLaw{ConstantLaw{160ms}});
}

TEST_F(Talk, EndsTheRunOnAStop)
{
    EXPECT_EQ(ask({{"command", "stop"}})["stopping"], true);
    EXPECT_TRUE(fake.is_stopped);
}

TEST_F(Talk, AppliesAPresetByItsName)
{
    EXPECT_NE(refused({{"command", "apply"}, {"preset", "fast"}}).find("fast"), std::string::npos);
    ask({{"command", "apply"}, {"preset", "slow"}});
    EXPECT_EQ(fake.delay(Direction::up), DelayLaw{ConstantLaw{700ms}});
}

TEST_F(Talk, NamesWhatItRefuses)
{
    EXPECT_NE(refused({{"command", "shwo"}}).find("show, set"), std::string::npos);
    EXPECT_NE(refused({{"command", "show"}, {"x", 1}}).find("\"x\""), std::string::npos);
    EXPECT_NE(refused({{"comand", "show"}}).find("\"command\" is missing"), std::string::npos);
    EXPECT_NE(refused({{"command", 1}}).find("string"), std::string::npos);
    EXPECT_NE(refused({1, 2}).find("JSON object"), std::string::npos);
    EXPECT_NE(refused(set({})).find("\"settings\""), std::string::npos);
    EXPECT_NE(refused(set({{"both.delay", 80}})).find("both.delay"), std::string::npos);
    EXPECT_NE(refused(set({{"both.dealy", "80ms"}})).find("both.dealy"), std::string::npos);
    EXPECT_NE(refused(set({{"both.delay", "80"}})).find("both.delay"), std::string::npos);
    auto brief = set({{"both.delay", "80ms"}});
    brief["for"] = "0";
    EXPECT_NE(refused(brief).find("\"for\""), std::string::npos);
    EXPECT_NE(refused({{"command", "apply"}}).find("\"profile\""), std::string::npos);
    EXPECT_NE(refused({{"command", "apply"}, {"profile", "delay = "}, {"file", "bad.toml"}})
                  .find("bad.toml:1"),
              std::string::npos);
}

TEST_F(Talk, RefusesLinesThatAreNoRequestAndGoesOn)
{
    const std::string deep(5000, '[');
    for (const std::string& line :
         {std::string{""}, std::string{"{"}, std::string{"null"}, std::string{"\xff\xfe"}, deep,
          std::string{R"({"command":"reset","command":"show"})"}}) {
        const auto reply = json::parse(said_to(conversation, line + "\n", fake, start));
        EXPECT_EQ(reply["ok"], false) << line;
        EXPECT_LT(reply.dump().size(), 2100U);
    }
    EXPECT_EQ(ask({{"command", "show"}})["ok"], true);
}

TEST_F(Talk, ShowsAProfileThatChangesNothingWhenApplied)
{
    ask(set({{"up.loss", "5%"}}));
    const auto shown = ask({{"command", "show"}});
    EXPECT_EQ(shown["live"][0]["settings"], (json{{"up.loss", "5%"}}));
    EXPECT_EQ(shown["live"][0]["remaining_s"], nullptr);
    const auto before = fake.director().path();
    const auto diff = ask({{"command", "diff"}, {"profile", shown["profile"]}});
    EXPECT_EQ(diff["changes"], json::array());
    EXPECT_EQ(diff["is_other_timeline"], false);
    ASSERT_EQ(ask({{"command", "apply"}, {"profile", shown["profile"]}})["ok"], true);
    EXPECT_EQ(fake.director().path(), before);
}

TEST_F(Talk, SaysHowLongASettingStillHolds)
{
    auto request = set({{"up.delay", "1s"}});
    request["for"] = "30s";
    ask(request);
    fake.paths.advance(start + 10s);
    const auto shown = ask({{"command", "show"}}, start + 10s);
    EXPECT_EQ(shown["live"][0]["remaining_s"], 20.0);
    EXPECT_EQ(shown["timeline"]["next_change_in_s"], 20.0);
}

TEST_F(Talk, SaysWhatApplyWouldChangeAndChangesNothing)
{
    const auto reply = ask({{"command", "diff"},
                            {"profile", "[both]\ndelay = \"160ms\"\n[down]\nloss = \"5%\"\n"
                                        "[[at]]\ntime = \"1s\"\nup.delay = \"0\"\n"}});
    EXPECT_EQ(reply["changes"], (json{{{"key", "down.loss"}, {"from", "none"}, {"to", "5%"}}}));
    EXPECT_EQ(reply["timeline"], (json{{"from", 0}, {"to", 1}}));
    EXPECT_EQ(reply["is_other_timeline"], true);
    EXPECT_EQ(fake.director().generation(), 1U);
}

TEST_F(Talk, GoesBackToTheBeginningOnReset)
{
    ask(set({{"both.delay", "80ms"}}));
    EXPECT_EQ(ask({{"command", "reset"}})["generation"], 3);
    EXPECT_EQ(fake.delay(Direction::up), DelayLaw{ConstantLaw{160ms}});
}

TEST_F(Talk, GivesTheStatisticsWithTheGeneration)
{
    const auto reply = ask({{"command", "stats"}});
    EXPECT_EQ(reply["up"]["received"], 0);
    EXPECT_EQ(reply["generation"], 1);
    EXPECT_EQ(reply["elapsed_s"], 0.0);
}

TEST_F(Talk, AnswersAWaitOnceItsConditionHolds)
{
    const json wait{{"command", "wait"}, {"until", "up.received>1000"}};
    EXPECT_EQ(said_to(conversation, wait.dump() + "\n", fake, start), "");
    const auto look = conversation.next_deadline();
    ASSERT_TRUE(look);
    fake.statistics["up"]["received"] = 1001;
    EXPECT_FALSE(conversation.advance(fake.subject, *look - 1ns));
    EXPECT_TRUE(conversation.advance(fake.subject, *look));
    const auto reply = json::parse(said_by(conversation, *look));
    EXPECT_EQ(reply["ok"], true);
    EXPECT_EQ(reply["met"], true);
    EXPECT_EQ(conversation.next_deadline(), std::nullopt);
}

TEST_F(Talk, AnswersAWaitWhoseTimeIsOver)
{
    const json wait{{"command", "wait"}, {"until", "up.lateness_us.p50<1"}, {"timeout", "1234us"}};
    EXPECT_EQ(said_to(conversation, wait.dump() + "\n", fake, start), "");
    EXPECT_EQ(conversation.next_deadline(), start + 1234us);
    EXPECT_TRUE(conversation.advance(fake.subject, start + 1234us));
    EXPECT_EQ(json::parse(said_by(conversation, start))["met"], false);
}

TEST_F(Talk, WaitsForPartsOfWhatIsStillNull)
{
    const json wait{{"command", "wait"}, {"until", "up.lens.delay_ms.mean>1"}};
    fake.statistics["up"]["lens"] = nullptr;
    EXPECT_EQ(said_to(conversation, wait.dump() + "\n", fake, start), "");
    const auto look = conversation.next_deadline();
    ASSERT_TRUE(look);
    fake.statistics["up"]["lens"] = {{"delay_ms", {{"mean", 20.5}}}};
    EXPECT_TRUE(conversation.advance(fake.subject, *look));
    EXPECT_EQ(json::parse(said_by(conversation, *look))["met"], true);
}

TEST_F(Talk, RefusesAConditionOnWhatIsNotThereSayingWhatIs)
{
    const auto error = [&](const char* until) {
        return refused({{"command", "wait"}, {"until", until}});
    };
    EXPECT_NE(error("up.recieved>1").find("in up: did you mean 'received'?"), std::string::npos);
    EXPECT_NE(error("x>1").find("down"), std::string::npos);
    EXPECT_NE(error("up>1").find("received"), std::string::npos);
    EXPECT_NE(error("up.received.x>1").find("'up.received' is a single value"), std::string::npos);
    EXPECT_NE(error("program>1").find("not a number"), std::string::npos);
    EXPECT_NE(error("up.received").find("up.received>1000"), std::string::npos);
    EXPECT_NE(error("up.received>x").find("a number, true or false"), std::string::npos);
    EXPECT_NE(error(">1").find("up.received>1000"), std::string::npos);
    EXPECT_NE(error("up.received>nan").find("a number"), std::string::npos);
}

TEST_F(Talk, KnowsSixComparisons)
{
    fake.statistics["up"]["received"] = 5;
    const auto met = [&](const char* until) {
        return ask({{"command", "wait"}, {"until", until}, {"timeout", "0"}})["met"] == true;
    };
    EXPECT_TRUE(met("up.received>=5") && met("up.received <= 5") && met("up.received==5"));
    EXPECT_TRUE(met("up.received!=4") && met("up.received>4") && met("up.received<6"));
    EXPECT_FALSE(met("up.received>5") || met("up.received<5") || met("up.received!=5"));
    EXPECT_TRUE(met("valid==true") && met("elapsed_s==0"));
}

TEST_F(Talk, WatchesUntilTheNextRequest)
{
    const auto first = said_to(conversation, "{\"command\":\"watch\"}\n", fake, start);
    EXPECT_EQ(std::count(first.begin(), first.end(), '\n'), 1);
    EXPECT_EQ(conversation.next_deadline(), start + 500ms);
    conversation.advance(fake.subject, start + 500ms);
    EXPECT_TRUE(json::parse(said_by(conversation, start))["up"].is_object());
    EXPECT_TRUE(ask({{"command", "show"}}).contains("profile"));
    EXPECT_EQ(conversation.next_deadline(), std::nullopt);
}

TEST_F(Talk, SkipsLinesOfAWatchThatItsReaderHasNoTimeFor)
{
    conversation.on_bytes("{\"command\":\"watch\",\"every\":\"50ms\"}\n");
    for (int i = 0; i < 1000; ++i) conversation.advance(fake.subject, start + i * 50ms);
    const auto said = said_by(conversation, start);
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1);
}

TEST_F(Talk, RefusesALineThatIsTooLongAndHearsNoMore)
{
    const std::string line(Conversation::line_bytes_max + 1, ' ');
    const auto reply = json::parse(said_to(conversation, line, fake, start));
    EXPECT_EQ(reply["ok"], false);
    EXPECT_TRUE(conversation.is_over());
    EXPECT_EQ(conversation.room(), 0U);
}

TEST_F(Talk, AnswersNothingMoreWhileItsRepliesAreNotRead)
{
    std::string many;
    for (int i = 0; i < 10'000; ++i) many += "{\"command\":\"show\"}\n";
    conversation.on_bytes(many);
    while (conversation.advance(fake.subject, start)) {}
    EXPECT_LT(conversation.output().size(), Conversation::unread_bytes_max + 1000);
    EXPECT_FALSE(conversation.is_stuck(start + Conversation::patience - 1ns));
    EXPECT_TRUE(conversation.is_stuck(start + Conversation::patience));
    EXPECT_EQ(conversation.next_deadline(), start + Conversation::patience);
}

TEST_F(Talk, AnswersWhatWasAskedBeforeTheClientEnded)
{
    conversation.on_bytes("{\"command\":\"show\"}\n{\"command\":\"stats\"}");
    conversation.on_end();
    EXPECT_FALSE(conversation.is_over());
    while (conversation.advance(fake.subject, start)) {}
    EXPECT_TRUE(conversation.is_over());
    const auto said = said_by(conversation, start);
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 2);
}

TEST_F(Talk, DoesWhatAClientAskedThatHasGone)
{
    conversation.on_bytes("{\"command\":\"wait\",\"until\":\"elapsed_s>9\"}\n" +
                          set({{"up.delay", "1ms"}}).dump() + "\n");
    conversation.advance(fake.subject, start);
    conversation.on_gone();
    while (conversation.advance(fake.subject, start)) {}
    EXPECT_EQ(fake.delay(Direction::up), DelayLaw{ConstantLaw{1ms}});
    EXPECT_TRUE(conversation.is_over());
    EXPECT_EQ(conversation.output(), "");
}

/// Conversations with an emulator of several paths.
struct TalkOfPaths {
    json ask(const json& request, base::TimePoint now = start)
    {
        return json::parse(said_to(conversation, request.dump() + "\n", fake, now));
    }

    EmulationFake fake;
    Conversation conversation{};
};

TEST(TalkOfLinks, NamesThemInSettingsAnswersAndProfiles)
{
    TalkOfPaths talk{EmulationFake{"[both]\ndelay = \"10ms\"\n", start, {"1-2", "1-3", "wan"}}};
    std::ignore = talk.fake.path().on_packet(Direction::up, {}, start);
    const auto done = talk.ask(set({{"2-1.delay", "20ms"}, {"all.mtu", "1500B"}}), start + 1s);
    EXPECT_EQ(done["generation"], 2);
    EXPECT_EQ(done["effective_at"], (json{{"1-2", {{"up", 1}, {"down", 0}}},
                                          {"1-3", {{"up", 0}, {"down", 0}}},
                                          {"wan", {{"up", 0}, {"down", 0}}}}));
    EXPECT_EQ(talk.fake.delay(Direction::up), DelayLaw{ConstantLaw{10ms}});
    EXPECT_EQ(talk.fake.delay(Direction::down), DelayLaw{ConstantLaw{20ms}});
    EXPECT_EQ(talk.ask(set({{"2-3.delay", "20ms"}}))["error"],
              "2-3.delay: there is no link 2-3: use one of 1-2, 1-3, wan");
    const auto shown = talk.ask({{"command", "show"}}, start + 1s);
    EXPECT_EQ(shown["live"],
              (json::array({{{"settings",
                              {{"up.mtu", "1500B"}, {"down.mtu", "1500B"}, {"2-1.delay", "20ms"}}},
                             {"remaining_s", nullptr}}})));
    const std::string profile = shown["profile"];
    EXPECT_NE(profile.find("[link.\"2-1\"]\ndelay = \"20ms\"\n"), std::string::npos) << profile;
    EXPECT_EQ(talk.ask({{"command", "diff"}, {"profile", profile}}, start + 1s)["changes"],
              json::array());
    EXPECT_EQ(talk.ask({{"command", "apply"}, {"profile", "[link.wan.up]\nloss = \"5%\"\n"}},
                       start + 2s)["changed"],
              true);
    const auto changes = talk.ask({{"command", "diff"}, {"profile", "[all]\nloss = \"5%\"\n"}},
                                  start + 2s)["changes"];
    EXPECT_EQ(changes.size(), 5U); // all ways but the one that has it
    EXPECT_EQ(changes[0], (json{{"key", "1-2.loss"}, {"from", "none"}, {"to", "5%"}}));
    EXPECT_EQ(talk.ask({{"command", "reset"}}, start + 3s)["generation"], 4);
    EXPECT_EQ(talk.fake.delay(Direction::down), DelayLaw{ConstantLaw{10ms}});
}

TEST(TalkOfClients, ReachesThoseThatAreNotThereYet)
{
    TalkOfPaths talk{EmulationFake{"[both]\ndelay = \"10ms\"\n", start, {"client.1"}, true}};
    EXPECT_EQ(talk.ask(set({{"client.2.up.delay", "20ms"}, {"both.delay", "30ms"}}))["changed"],
              true);
    EXPECT_EQ(talk.fake.delay(Direction::up), DelayLaw{ConstantLaw{30ms}});
    const auto& second = talk.fake.paths.add("client.2");
    EXPECT_EQ(second.link(Direction::up).conditions().delay.law, DelayLaw{ConstantLaw{20ms}});
    EXPECT_EQ(second.link(Direction::down).conditions().delay.law, DelayLaw{ConstantLaw{30ms}});
    EXPECT_EQ(talk.ask({{"command", "show"}})["profile"], "\n[both]\ndelay = \"30ms\"\n");
    EXPECT_EQ(talk.ask(set({{"1-2.delay", "1ms"}}))["error"],
              "1-2.delay: there is no link 1-2: start the emulator with --link "
              "1-2=LISTEN_A,LISTEN_B");
}

} // namespace
} // namespace hapnet::emulator
