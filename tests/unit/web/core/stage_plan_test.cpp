// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/stage_plan.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::web {
namespace {

const StageFolders folders{"/bin", "/sockets", "/out", "/kept"};

TEST(StagePlan, StartsSimulatedPeersByClosedSetsOnly)
{
    const auto places = places_in("ready a=127.0.0.1:1 b=127.0.0.1:2", 2);
    ASSERT_TRUE(places);
    const Start peer = peer_start(2, Choice{}, folders, *places);
    const std::vector<std::string> words{"/bin/hapnet-peer",
                                         "--id",
                                         "2",
                                         "--listen",
                                         "127.0.0.1:0",
                                         "--remote",
                                         "127.0.0.1:2",
                                         "--keep",
                                         "20s",
                                         "--keep-in",
                                         "/kept",
                                         "--device",
                                         "sim",
                                         "--task",
                                         "P1",
                                         "--algorithm",
                                         "base",
                                         "--seed",
                                         "1",
                                         "--duration",
                                         "30s",
                                         "--control",
                                         "/sockets/peer-2.sock",
                                         "--record",
                                         "/out/peer-2.rec",
                                         "--stats",
                                         "/out/peer-2.json"};
    EXPECT_EQ(peer.words, words);
    const std::vector<std::string> emulator{"/bin/hapnet-emulator",
                                            "--listen-a",
                                            "127.0.0.1:0",
                                            "--listen-b",
                                            "127.0.0.1:0",
                                            "--keep",
                                            "20s",
                                            "--keep-in",
                                            "/kept",
                                            "--profile",
                                            "paper-delay-160",
                                            "--seed",
                                            "1",
                                            "--control",
                                            "/sockets/emulator.sock",
                                            "--stats",
                                            "/out/emulator.json"};
    EXPECT_EQ(emulator_start(Choice{}, folders).words, emulator);
    EXPECT_FALSE(places_in("ready a=127.0.0.1:1", 2));
}

TEST(StagePlan, StartsVirtualTimeWithTheOtherAlgorithmsBesideTheChosenOne)
{
    const Choices choices = all_choices({"ideal", "paper-delay-160"});
    Choice choice{.mode = "virtual", .algorithm = "sep"};
    const std::vector<std::string> words{"/bin/hapnet-lab", "play",
                                         "--task",          "P1",
                                         "--algorithm",     "sep",
                                         "--algorithm",     "base",
                                         "--algorithm",     "dead-reckoning",
                                         "--profile",       "paper-delay-160",
                                         "--seed",          "1",
                                         "--duration",      "30s",
                                         "--peers",         "2",
                                         "--control",       "/sockets/lab.sock",
                                         "--out",           "/out"};
    EXPECT_EQ(lab_start(choice, folders, choices).words, words);
    EXPECT_EQ(lab_peer_sockets("/sockets/lab.sock", 2),
              (std::vector<std::string>{"/sockets/lab.sock.peer-1", "/sockets/lab.sock.peer-2"}));
    EXPECT_FALSE(choice_of({{"mode", "virtual"}, {"seed", 1'000'000'001}}, Choice{}, choices));
    EXPECT_TRUE(choice_of({{"mode", "live"}, {"seed", 1'000'000'001}}, Choice{}, choices));
}

TEST(StagePlan, RefusesWhatIsNotInItsSets)
{
    const Choices choices = all_choices({"ideal", "paper-delay-160"});
    for (const char* request :
         {R"({"mode":"real"})", R"({"task":"P1 --insecure"})", R"({"algorithm":"/tmp/x.so"})",
          R"({"preset":"../../etc/passwd"})", R"({"peers":1})", R"({"peers":9})",
          R"({"seconds":4})", R"({"seconds":"30"})", R"({"seed":0})", R"({"loop":1})",
          R"({"device":"sim"})", R"({"peers":3})"}) {
        EXPECT_FALSE(choice_of(nlohmann::ordered_json::parse(request), Choice{}, choices))
            << request;
    }
    const auto fine = choice_of({{"task", "T7"}, {"peers", 3}}, Choice{}, choices);
    ASSERT_TRUE(fine);
    EXPECT_EQ(fine->peers, 3);
}

} // namespace
} // namespace hapnet::web
