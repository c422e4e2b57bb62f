// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/control/answer.hpp"

#include "tests/unit/peer/control/fake_peer_control.hpp"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

const base::TimePoint opening{100s};

struct TalkWithAPeer : testing::Test {
    std::string said(base::TimePoint now)
    {
        std::string said{conversation.output()};
        conversation.on_written(said.size(), now);
        return said;
    }

    std::string said_to(std::string_view text, base::TimePoint now = opening)
    {
        conversation.on_bytes(text);
        while (conversation.advance(fake.subject, now)) {}
        return said(now);
    }

    json ask(const json& request)
    {
        const auto line = said_to(request.dump() + "\n");
        EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
        return json::parse(line, nullptr, false);
    }

    std::string refused(const json& request)
    {
        const auto reply = ask(request);
        EXPECT_EQ(reply["ok"], false) << reply;
        return reply["error"];
    }

    static constexpr std::size_t line_max = 1000;
    FakePeerControl fake;
    control::Conversation conversation{line_max};
};

TEST_F(TalkWithAPeer, MovesTheHandOfAPageAndOfNoOtherDevice)
{
    const json request{{"command", "hand"}, {"x", 0.01}, {"y", 0}, {"z", -0.25}};
    EXPECT_EQ(refused(request), "'hand' moves the hand of --device page, and this peer has "
                                "another device");
    EXPECT_TRUE(fake.hand.empty());
    EXPECT_EQ(refused({{"command", "shwo"}}).find("hand"), std::string::npos);
    fake.subject = subject_of(fake.controls(true));
    EXPECT_NE(refused({{"command", "shwo"}}).find("keep, hand, stop"), std::string::npos);
    EXPECT_EQ(ask(request), (json{{"ok", true}}));
    const device::HandWish wish{{{0.01, 0.0, -0.25}}};
    EXPECT_EQ(fake.hand, (std::vector<std::optional<device::HandWish>>{wish}));
}

TEST_F(TalkWithAPeer, GripsAndLetsGoWithTheHandOfAPage)
{
    fake.subject = subject_of(fake.controls(true));
    EXPECT_EQ(ask({{"command", "hand"}, {"x", 0}, {"y", 0}, {"z", 0}, {"grip", true}})["ok"], true);
    EXPECT_EQ(ask({{"command", "hand"}, {"let_go", true}})["ok"], true);
    const device::HandWish gripping{.place = {}, .grips = true};
    EXPECT_EQ(fake.hand, (std::vector<std::optional<device::HandWish>>{gripping, std::nullopt}));
    EXPECT_EQ(refused({{"command", "hand"}, {"let_go", 1}}), "\"let_go\" must be true or false");
    EXPECT_EQ(refused({{"command", "hand"}, {"x", 0}, {"y", 0}, {"z", 0}, {"grip", "yes"}}),
              "\"grip\" must be true or false");
    EXPECT_NE(refused({{"command", "hand"}, {"let_go", true}, {"x", 0}}), "");
    EXPECT_EQ(fake.hand.size(), 2U);
}

TEST_F(TalkWithAPeer, RefusesPlacesThatAreNoneAndGoesOn)
{
    fake.subject = subject_of(fake.controls(true));
    for (const char* bad :
         {R"("x":0,"y":0)", R"("x":0.26,"y":0,"z":0)", R"("x":0,"y":-1e300,"z":0)",
          R"("x":0,"y":0,"z":"0")", R"("x":0,"y":0,"z":null)", R"("x":true,"y":0,"z":0)",
          R"("x":[0],"y":0,"z":0)", R"("x":0,"y":0,"z":0,"w":0)", R"("x":1e999,"y":0,"z":0)",
          R"("x":NaN,"y":0,"z":0)", R"("x":0,"x":0.1,"y":0,"z":0)"}) {
        const auto line = said_to(std::string{R"({"command":"hand",)"} + bad + "}\n");
        EXPECT_EQ(json::parse(line)["ok"], false) << bad;
    }
    EXPECT_TRUE(fake.hand.empty());
    EXPECT_EQ(refused({{"command", "hand"}, {"x", 0}, {"y", 0.3}, {"z", 0}}),
              "\"y\" must be a number of metres from -0.25 to 0.25");
    EXPECT_EQ(ask({{"command", "hand"}, {"x", 0}, {"y", 0}, {"z", 0}})["ok"], true);
}

TEST_F(TalkWithAPeer, SavesWhatItHoldsUnderPlainNamesOnly)
{
    EXPECT_EQ(ask({{"command", "keep"}, {"name", "trap-1"}, {"last", "5s"}}),
              (json{{"ok", true},
                    {"file", "/there/trap-1.rec"},
                    {"from_ns", (opening - 5s).time_since_epoch().count()},
                    {"to_ns", opening.time_since_epoch().count()}}));
    EXPECT_EQ(fake.kept_from, opening - 5s);
    EXPECT_EQ(ask({{"command", "keep"}, {"name", "all"}})["ok"], true);
    EXPECT_EQ(fake.kept_from, opening - 20s) << "as much as is held";
    fake.kept.clear();
    for (const char* name :
         {"", "../x", "a/b", "A", "a.b", "a b", "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"}) {
        EXPECT_NE(refused({{"command", "keep"}, {"name", name}}), "") << name;
    }
    EXPECT_NE(refused({{"command", "keep"}}), "");
    EXPECT_NE(refused({{"command", "keep"}, {"name", "a"}, {"last", "21s"}}), "");
    EXPECT_NE(refused({{"command", "keep"}, {"name", "a"}, {"in", "/etc"}}), "");
    EXPECT_EQ(fake.kept, "");
    EXPECT_EQ(refused({{"command", "keep"}, {"name", "full"}}), "it is full");
}

TEST_F(TalkWithAPeer, ShowsAndGivesStatisticsAsTheyAre)
{
    EXPECT_EQ(ask({{"command", "show"}}),
              (json{{"ok", true}, {"program", "hapnet-peer"}, {"state", "running"}}));
    json expected = fake.statistics;
    expected["ok"] = true;
    EXPECT_EQ(ask({{"command", "stats"}}), expected);
}

TEST_F(TalkWithAPeer, TellsItsMetricsWithItsId)
{
    fake.statistics["tick"] = {{"count", 5}, {"late_us", {{"p99", 20.0}}}};
    const auto reply = ask({{"command", "metrics"}});
    EXPECT_EQ(reply["ok"], true);
    ASSERT_EQ(reply["metrics"].size(), 2U) << reply;
    EXPECT_EQ(reply["metrics"][0]["name"], "hapnet_peer_ticks_total");
    EXPECT_EQ(reply["metrics"][0]["samples"],
              (json::array({{{"labels", {{"peer", "7"}}}, {"value", 5.0}}})));
    EXPECT_EQ(reply["metrics"][1]["name"], "hapnet_peer_tick_lateness_p99_seconds");
    EXPECT_EQ(reply["metrics"][1]["samples"][0]["value"], 20e-6);
    EXPECT_NE(refused({{"command", "metrics"}, {"of", "all"}}).find("\"of\""), std::string::npos);
}

TEST_F(TalkWithAPeer, StopsOnceAskedToAndAnswersFirst)
{
    EXPECT_EQ(ask({{"command", "stop"}}), (json{{"ok", true}, {"stopping", true}}));
    EXPECT_EQ(fake.stops, 1);
    EXPECT_NE(refused({{"command", "stop"}, {"for", "1s"}}).find("\"for\""), std::string::npos);
    EXPECT_EQ(fake.stops, 1) << "a request that is refused does nothing";
    EXPECT_EQ(fake.emergency_stops, 0);
    EXPECT_EQ(ask({{"command", "estop"}}), (json{{"ok", true}, {"force", "off"}}));
    EXPECT_EQ(fake.emergency_stops, 1);
    EXPECT_EQ(fake.stops, 1);
}

TEST_F(TalkWithAPeer, RefusesWhatWouldChangeItSayingWhatThereIs)
{
    for (const char* command : {"set", "apply", "diff", "reset"}) {
        const auto error = refused({{"command", command}, {"profile", ""}, {"settings", 1}});
        EXPECT_NE(error.find("cannot be changed"), std::string::npos) << error;
        EXPECT_NE(error.find(command), std::string::npos) << error;
        EXPECT_NE(error.find("show, scene, stats, metrics, watch, wait, keep, stop or estop"),
                  std::string::npos)
            << error;
    }
    EXPECT_NE(refused({{"command", "shwo"}}).find("must be one of show"), std::string::npos);
    EXPECT_EQ(fake.stops, 0);
}

TEST_F(TalkWithAPeer, WaitsForItsStatistics)
{
    EXPECT_EQ(said_to("{\"command\":\"wait\",\"until\":\"tick.count>5\"}\n"), "");
    fake.statistics["tick"]["count"] = 6;
    const auto look = conversation.next_deadline();
    ASSERT_TRUE(look);
    EXPECT_TRUE(conversation.advance(fake.subject, *look));
    EXPECT_EQ(json::parse(said(*look)),
              (json{{"ok", true}, {"until", "tick.count>5"}, {"met", true}, {"elapsed_s", 2.5}}));
    EXPECT_NE(refused({{"command", "wait"}, {"until", "tick.cuont>5"}}).find("count"),
              std::string::npos);
    EXPECT_NE(refused({{"command", "wait"}}).find("\"until\" is missing"), std::string::npos);
}

TEST_F(TalkWithAPeer, WatchesUntilTheNextRequest)
{
    const auto first = said_to("{\"command\":\"watch\",\"every\":\"50ms\"}\n");
    EXPECT_EQ(json::parse(first)["tick"]["count"], 5);
    EXPECT_EQ(conversation.next_deadline(), opening + 50ms);
    EXPECT_EQ(ask({{"command", "show"}})["state"], "running");
    EXPECT_EQ(conversation.next_deadline(), std::nullopt);
}

TEST_F(TalkWithAPeer, RefusesGarbageAndGoesOn)
{
    const std::string deep(900, '[');
    for (const std::string& line :
         {std::string{""}, std::string{"{"}, std::string{"null"}, std::string{"\xff\xfe"}, deep,
          std::string{R"({"command":"stop","command":"show"})"}, std::string{R"({"command":1})"}}) {
        EXPECT_EQ(json::parse(said_to(line + "\n"))["ok"], false) << line;
    }
    EXPECT_EQ(fake.stops, 0);
    EXPECT_EQ(said_to("{\"command\":"), "") << "half a line is no request";
    EXPECT_EQ(json::parse(said_to("\"show\"}\n"))["ok"], true);
}

TEST_F(TalkWithAPeer, HearsNoMoreOfAClientWhoseLineIsLongerThanItsBound)
{
    EXPECT_EQ(conversation.room(), line_max + 1);
    EXPECT_EQ(json::parse(said_to(std::string(line_max + 1, ' ')))["ok"], false);
    EXPECT_TRUE(conversation.is_over());
    EXPECT_EQ(conversation.room(), 0U);
}

} // namespace
} // namespace hapnet::peer
