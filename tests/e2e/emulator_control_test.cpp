// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A running emulator, changed and asked with hapnet-ctl and over its socket.
#include "proto/net/unix_socket.hpp"
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/udp.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <sys/stat.h>
#include <thread>
#include <tuple>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;
using nlohmann::json;

struct Controlled : testing::Test {
    Outcome ctl(std::vector<std::string> words)
    {
        words.insert(words.begin(), socket);
        return run("hapnet-ctl", words);
    }

    json asked(std::vector<std::string> words)
    {
        words.insert(words.begin(), "--json");
        const auto outcome = ctl(words);
        EXPECT_EQ(outcome.exit, 0) << outcome.err;
        return json::parse(outcome.out, nullptr, false);
    }

    void expect_refusal(const std::vector<std::string>& words, int exit, const char* word)
    {
        const auto outcome = ctl(words);
        EXPECT_EQ(outcome.exit, exit) << outcome.out;
        EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    }

    TemporaryFolder folder;
    std::string socket = folder.file("emulator.sock");
};

} // namespace

TEST_F(Controlled, TakesEffectExactlyAtTheDatagramThatTheAnswerNames)
{
    Host a;
    Host b;
    Emulator emulator{{"--a", a.endpoint().to_text(), "--b", b.endpoint().to_text(), "--delay",
                       "20ms", "--control", socket}};
    std::optional<json> reply;
    std::atomic<std::uint64_t> sent{0};
    std::atomic<bool> is_answered{false};
    std::thread person{[&] {
        std::ignore = comes_true([&] { return sent > 200; });
        reply = asked({"set", "up.loss", "100%"});
        is_answered = true;
    }};
    for (int after = 0; after < 200; after += is_answered ? 1 : 0) {
        a.send(emulator.a(), sent);
        ++sent;
        std::this_thread::sleep_for(1ms);
    }
    person.join();
    ASSERT_TRUE(reply);
    const auto first_lost = (*reply)["effective_at"]["up"].get<std::uint64_t>();
    EXPECT_GT(first_lost, 100U);
    EXPECT_LT(first_lost, sent.load());
    const auto arrivals = b.receive(sent, 300ms);
    ASSERT_EQ(arrivals.size(), first_lost);
    EXPECT_EQ(arrivals.back().number, first_lost - 1);
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["up"]["dropped"]["random_loss"], sent.load() - first_lost);
}

TEST_F(Controlled, ShowsAProfileThatCanBeAppliedAndReturnsToItsStart)
{
    Emulator emulator{{"--delay", "160ms", "--control", socket}};
    EXPECT_EQ(asked({"set", "both.delay", "80ms", "up.loss", "5%"})["generation"], 2);
    const auto shown = ctl({"show"});
    std::ofstream{folder.file("now.toml")} << shown.out;
    EXPECT_NE(shown.out.find("\ndelay = \"80ms\""), std::string::npos) << shown.out;
    EXPECT_NE(shown.out.find("set by hand: up.loss = 5%"), std::string::npos) << shown.out;
    EXPECT_EQ(ctl({"diff", folder.file("now.toml")}).out, "nothing would change\n");
    EXPECT_EQ(asked({"reset"})["generation"], 3);
    EXPECT_NE(ctl({"diff", folder.file("now.toml")}).out.find("up.delay: 160ms -> 80ms\n"),
              std::string::npos);
    EXPECT_EQ(asked({"apply", folder.file("now.toml")})["generation"], 4);
    EXPECT_EQ(asked({"apply", folder.file("now.toml")})["generation"], 4) << "idempotent";
    EXPECT_EQ(json::parse(ctl({"stats"}).out, nullptr, false)["generation"], 4);
}

TEST_F(Controlled, RestoresByItselfWhatWasChangedForATime)
{
    Host a;
    Host b;
    Emulator emulator{
        {"--a", a.endpoint().to_text(), "--b", b.endpoint().to_text(), "--control", socket}};
    asked({"set", "up.loss", "100%", "--for", "500ms"});
    a.send(emulator.a(), 0);
    EXPECT_TRUE(b.receive(1, 100ms).empty());
    EXPECT_EQ(asked({"wait", "--until", "generation>=3", "--timeout", "5s"})["met"], true);
    a.send(emulator.a(), 1);
    EXPECT_EQ(b.receive(1, 1s).size(), 1U);
    EXPECT_EQ(asked({"show"})["live"], json::array());
    const json statistics = emulator.stop();
    ASSERT_EQ(statistics["changes"].size(), 2U);
    const json& set = statistics["changes"][0];
    EXPECT_EQ(set["generation"], 2);
    EXPECT_EQ(set["by"], "hand");
    EXPECT_EQ(set["effective_at"]["up"], 0);
    EXPECT_EQ(set["settings"], (json{{"up.loss", "100%"}}));
    EXPECT_EQ(statistics["changes"][1]["effective_at"]["up"], 1);
    EXPECT_EQ(statistics["changes"][1]["settings"], (json{{"up.loss", "none"}}));
    EXPECT_EQ(statistics["changes_omitted"], 0);
    EXPECT_EQ(statistics["configuration_at_start"], statistics["configuration_at_end"]);
}

TEST_F(Controlled, HearsEachHangupWithoutTrafficThatWouldWakeIt)
{
    const std::string profile = folder.file("profile.toml");
    std::ofstream{profile} << "[both]\ndelay = \"1ms\"\n";
    Emulator emulator{{"--profile", profile}};
    for (int times = 1; times <= 100; ++times) {
        std::ofstream{profile} << "[both]\ndelay = \"" << times << "\"\n"; // without a unit
        emulator.process().signal(SIGHUP);
        const std::string why = "'" + std::to_string(times) + "' has no unit";
        ASSERT_TRUE(emulator.process().wait_for_err(why, 5s)) << "hangup " << times;
    }
    std::ignore = emulator.stop();
}

TEST_F(Controlled, ReadsItsProfileAgainOnAHangupAndKeepsTheOldOneWhenTheNewOneIsWrong)
{
    const std::string profile = folder.file("profile.toml");
    std::ofstream{profile} << "[both]\ndelay = \"160ms\"\n";
    Emulator emulator{{"--profile", profile, "--control", socket}};
    std::ofstream{profile} << "[both]\ndelay = \"80\"\n";
    emulator.process().signal(SIGHUP);
    const auto why = emulator.process().wait_for_err("profile.toml:2", 5s);
    EXPECT_TRUE(why) << emulator.process().err();
    EXPECT_EQ(asked({"show"})["generation"], 1);
    std::ofstream{profile} << "[both]\ndelay = \"80ms\"\n";
    emulator.process().signal(SIGHUP);
    EXPECT_EQ(asked({"wait", "--until", "generation>=2", "--timeout", "5s"})["met"], true);
    EXPECT_NE(ctl({"show"}).out.find("delay = \"80ms\""), std::string::npos);
    std::ignore = emulator.stop();
}

TEST_F(Controlled, ReadsTheFatesThatItReplaysOnce)
{
    const std::string profile = folder.file("profile.toml");
    const std::string fates = folder.file("fates.csv");
    std::ofstream{profile} << "both.rate = \"1Mbit/s\"\n";
    std::ofstream{fates} << "direction,number,verdict,cause,states,delay_ns,copy_after_ns,"
                            "flipped_bits,displaced_places,displaced_ns\n";
    Emulator emulator{{"--profile", profile, "--replay", fates, "--control", socket}};
    std::filesystem::remove(fates);
    std::ofstream{profile} << "both.rate = \"2Mbit/s\"\n";
    emulator.process().signal(SIGHUP);
    EXPECT_EQ(asked({"wait", "--until", "generation>=2", "--timeout", "5s"})["met"], true);
    std::ignore = emulator.stop();
}

TEST_F(Controlled, WaitsForAConditionAndSaysWhenItsTimeIsOver)
{
    Host a;
    Emulator emulator{{"--control", socket}};
    Process waiting{"hapnet-ctl", {socket, "wait", "--until", "up.received>=3"}};
    EXPECT_EQ(waiting.wait_exit(300ms), std::nullopt);
    stream(a, emulator.a(), 3, 1ms);
    EXPECT_EQ(waiting.wait_exit(5s), 0);
    EXPECT_EQ(ctl({"wait", "--until", "up.received>3", "--timeout", "200ms"}).exit, 1);
    expect_refusal({"wait", "--until", "up.recieved>3"}, 2, "received");
}

TEST_F(Controlled, WatchesALineAtATimeUntilItIsInterrupted)
{
    Emulator emulator{{"--control", socket}};
    const auto begin = std::chrono::steady_clock::now();
    Process watching{"hapnet-ctl", {socket, "watch", "--every", "50ms"}};
    const auto lines = [&] {
        return std::count(watching.out().begin(), watching.out().end(), '\n');
    };
    EXPECT_TRUE(comes_true([&] { return lines() >= 5; })) << watching.out();
    watching.signal(SIGINT);
    EXPECT_EQ(watching.wait_exit(5s), 0) << watching.err();
    EXPECT_LE(lines(), 2 + (std::chrono::steady_clock::now() - begin) / 50ms);
    EXPECT_NE(watching.out().find(" up.received=0 "), std::string::npos) << watching.out();
}

TEST_F(Controlled, SaysWhatIsWrongWithACommand)
{
    Emulator emulator{{"--control", socket}};
    expect_refusal({"set", "both.dealy", "80ms"}, 2, "delay");
    expect_refusal({"set", "both.delay", "80"}, 2, "'80'");
    expect_refusal({"set", "both.delay"}, 2, "has no value");
    expect_refusal({"set", "both.delay", "1ms", "--for", "5"}, 2, "--for");
    expect_refusal({"shwo"}, 2, "'shwo'");
    expect_refusal({"apply", folder.file("none.toml")}, 2, "none.toml");
    std::ofstream{folder.file("bad.toml")} << "\n[both]\ndelay = \"80\"\n";
    expect_refusal({"apply", folder.file("bad.toml")}, 2, "bad.toml:3");
    EXPECT_EQ(asked({"show"})["generation"], 1);
    EXPECT_EQ(run("hapnet-ctl", {"show"}).exit, 2);
    const auto help = run("hapnet-ctl", {"--help"});
    EXPECT_EQ(help.exit, 0);
    for (const char* word : {"show", "set", "apply", "diff", "reset", "stats", "watch", "wait",
                             "stop", "Examples", "Exit codes", "SOCKET"}) {
        EXPECT_NE(help.out.find(word), std::string::npos) << word;
    }
}

TEST_F(Controlled, SaysThatNoEmulatorAnswers)
{
    expect_refusal({"show"}, 3, "--control");
    std::ofstream{socket} << "no socket";
    expect_refusal({"show"}, 3, "--control");
}

TEST_F(Controlled, OwnsItsSocketAloneAndLeavesNoneBehind)
{
    const std::vector<std::string> another{"--listen-a",  "127.0.0.1:0", "--listen-b",
                                           "127.0.0.1:0", "--control",   socket};
    {
        Emulator killed{{"--control", socket}};
        killed.process().signal(SIGKILL);
        EXPECT_EQ(killed.process().wait_exit(5s), 128 + SIGKILL);
    }
    Emulator emulator{{"--control", socket}};
    struct stat found {};
    ASSERT_EQ(stat(socket.c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777U, 0600U);
    const auto second = run("hapnet-emulator", another);
    EXPECT_EQ(second.exit, 3);
    EXPECT_NE(second.err.find(socket), std::string::npos) << second.err;
    EXPECT_EQ(asked({"show"})["ok"], true);
    std::ignore = emulator.stop();
    EXPECT_TRUE(folder.names().empty());
}

TEST_F(Controlled, AnswersGarbageWithAnErrorAndLives)
{
    Emulator emulator{{"--control", socket}};
    std::string keys = "{\"0\":0";
    for (int i = 1; i < 90'000; ++i) keys += ",\"" + std::to_string(i) + "\":0";
    for (const std::string& text :
         {keys + "}\n", std::string{"\n"}, std::string{"\xff\xfe{\n"},
          std::string(100'000, '[') + "\n",
          std::string{"{\"command\":\"set\",\"settings\":{\"up.delay\":5}}\n"},
          std::string((3 << 20) + 10, 'x')}) {
        const auto reply = json::parse(said_by(socket, text), nullptr, false);
        EXPECT_EQ(reply.value("ok", true), false) << reply;
    }
    EXPECT_EQ(asked({"show"})["ok"], true);
}

TEST_F(Controlled, ServesAFewClientsAtATimeAndTellsTheOthers)
{
    Emulator emulator{{"--control", socket}};
    std::vector<net::UnixStream> clients;
    for (int i = 0; i < 1000; ++i) {
        clients.push_back(net::UnixStream::connect(socket));
        if (i >= 16) {
            EXPECT_NE(heard(clients.back()).find("\"busy\":true"), std::string::npos) << i;
        }
        if (clients.size() > 17) clients.pop_back();
    }
    expect_refusal({"show"}, 3, "too many");
    clients.clear();
    for (int i = 0; i < 100; ++i) {
        EXPECT_NE(said_by(socket, "{\"command\":\"show\"}\n").find("\"ok\":true"),
                  std::string::npos)
            << i;
    }
}

} // namespace hapnet::e2e
