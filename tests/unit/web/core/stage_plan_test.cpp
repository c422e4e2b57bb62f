// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/stage_plan.hpp"

#include <algorithm>
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
                                         "--out",           "/out",
                                         "--device",        "sim"};
    EXPECT_EQ(lab_start(choice, folders, choices).words, words);
    EXPECT_EQ(lab_peer_sockets("/sockets/lab.sock", 2),
              (std::vector<std::string>{"/sockets/lab.sock.peer-1", "/sockets/lab.sock.peer-2"}));
    EXPECT_FALSE(choice_of({{"mode", "virtual"}, {"seed", 1'000'000'001}}, Choice{}, choices));
    EXPECT_TRUE(choice_of({{"mode", "live"}, {"seed", 1'000'000'001}}, Choice{}, choices));
}

TEST(StagePlan, GivesTheHandOfAPageToAAlone)
{
    const auto places = places_in("ready a=127.0.0.1:1 b=127.0.0.1:2", 2);
    ASSERT_TRUE(places);
    const Choices choices = all_choices({"paper-delay-160"});
    const auto choice = choice_of({{"device", "page"}}, Choice{}, choices);
    ASSERT_TRUE(choice);
    const auto device_in = [](const Start& start) {
        const auto option = std::ranges::find(start.words, "--device");
        return option == start.words.end() ? "" : *(option + 1);
    };
    EXPECT_EQ(device_in(peer_start(1, *choice, folders, *places)), "page");
    EXPECT_EQ(device_in(peer_start(2, *choice, folders, *places)), "sim");
    EXPECT_EQ(device_in(lab_start(*choice, folders, choices)), "page");
    EXPECT_EQ(device_in(peer_start(1, Choice{}, folders, *places)), "sim");
}

TEST(StagePlan, RefusesWhatIsNotInItsSets)
{
    const Choices choices = all_choices({"ideal", "paper-delay-160"});
    for (const char* request :
         {R"({"mode":"real"})", R"({"task":"P1 --insecure"})", R"({"algorithm":"/tmp/x.so"})",
          R"({"preset":"../../etc/passwd"})", R"({"peers":1})", R"({"peers":9})",
          R"({"seconds":4})", R"({"seconds":"30"})", R"({"seed":0})", R"({"loop":1})",
          R"({"device":"sim"})", R"({"device":"falcon"})", R"({"device":"replay:/etc/passwd"})",
          R"({"device":["page"]})", R"({"peers":3})"}) {
        EXPECT_FALSE(choice_of(nlohmann::ordered_json::parse(request), Choice{}, choices))
            << request;
    }
    const auto fine = choice_of({{"task", "T7"}, {"peers", 3}}, Choice{}, choices);
    ASSERT_TRUE(fine);
    EXPECT_EQ(fine->peers, 3);
}

TEST(StagePlan, StartsFromAStoryAndChangesWhatTheRequestNames)
{
    const Choices choices = all_choices({"ideal", "loss-97"});
    const Choice before{.mode = "virtual", .peers = 3, .seed = 7, .loop = false};
    const auto told = choice_of({{"do", "start"}, {"story", "loss-97"}}, before, choices);
    ASSERT_TRUE(told);
    EXPECT_EQ(*told, (Choice{.mode = "virtual",
                             .task = "T3",
                             .algorithm = "remote-proxy",
                             .preset = "loss-97",
                             .loop = false}));
    const auto changed = choice_of({{"story", "loss-97"}, {"preset", "ideal"}}, before, choices);
    ASSERT_TRUE(changed);
    EXPECT_EQ(changed->preset, "ideal");
    EXPECT_EQ(changed->task, "T3");
    EXPECT_FALSE(choice_of({{"story", "loss-98"}}, before, choices));
}

TEST(StagePlan, TellsStoriesThatItsOwnSetsHold)
{
    std::vector<std::string> presets;
    for (const Story& story : all_choices({}).stories) presets.push_back(story.choice.preset);
    const Choices choices = all_choices(presets);
    EXPECT_EQ(choices.stories.size(), 5U);
    for (const Story& story : choices.stories) {
        EXPECT_EQ(choice_of(story.choice.json(), Choice{}, choices), story.choice) << story.name;
        EXPECT_TRUE(story.look.ends_with('.')) << story.look;
    }
}

TEST(StagePlan, TellsWhatAProfileIsByItsFirstSentence)
{
    EXPECT_EQ(
        about_profile("# SPDX-License-Identifier: MIT\n# Fig. 6b of\n# it. Then more.\nx = 1\n"),
        "Fig. 6b of it.");
    EXPECT_EQ(about_profile("# None"), "None");
    EXPECT_EQ(about_profile("name = \"x\""), "");
    EXPECT_LE(about_profile("# " + std::string(80, 'a') + " " + std::string(100, 'b')).size(),
              160U);
}

TEST(StagePlan, NamesASceneOnlyWhereItIsNotTheTasks)
{
    const Choices choices = all_choices({"paper-delay-160"});
    const auto chosen = choice_of({{"scene", "rolling"}}, Choice{}, choices);
    ASSERT_TRUE(chosen);
    const auto names = [](const Start& start, const std::string& word) {
        return std::ranges::find(start.words, word) != start.words.end();
    };
    const auto places = places_in("ready a=127.0.0.1:1 b=127.0.0.1:2", 2);
    ASSERT_TRUE(places);
    EXPECT_TRUE(names(peer_start(1, *chosen, folders, *places), "rolling"));
    EXPECT_TRUE(names(lab_start(*chosen, folders, choices), "scene=rolling"));
    EXPECT_FALSE(names(peer_start(1, Choice{}, folders, *places), "--scene"));
    EXPECT_FALSE(choice_of({{"scene", "cubes-1000"}}, Choice{}, choices));
    const auto crowd =
        choice_of({{"scene", "paper"}, {"task", "T7"}, {"peers", 3}}, Choice{}, choices);
    ASSERT_FALSE(crowd);
    EXPECT_EQ(crowd.error().message, "the scene paper is for two peers; with 3 leave the scene at "
                                     "task, that of the task");
}

} // namespace
} // namespace hapnet::web
