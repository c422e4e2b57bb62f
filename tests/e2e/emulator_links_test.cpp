// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Many pairs through one emulator, and the records of many clients.
#include "emulator/core/fates/fates.hpp"
#include "proto/net/clock.hpp"
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/process.hpp"
#include "tests/e2e/udp.hpp"

#include <algorithm>
#include <csignal>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;
using emulator::FatesOfPaths;
using emulator::parse_fates_of_paths;

/// An emulator with links of these names, and two hosts for each link.
class LinksRunning {
public:
    struct Pair {
        net::Endpoint listen_1;
        net::Endpoint listen_2;
        Host first{};
        Host second{};
    };

    LinksRunning(const std::vector<std::string>& names, const std::vector<std::string>& options)
    {
        std::vector<std::string> words{"--stats", folder.file("stats.json"), "--control",
                                       folder.file("s")};
        for (const std::string& name : names) {
            words.insert(words.end(), {"--link", name + "=127.0.0.1:0,127.0.0.1:0"});
        }
        words.insert(words.end(), options.begin(), options.end());
        process.emplace("hapnet-emulator", words);
        const auto ready = process->wait_for_out("ready ", 10s);
        if (!ready) throw std::runtime_error{"the emulator is not ready: " + process->err()};
        for (const std::string& name : names) {
            const auto at = ready->find(name + "=") + name.size() + 1;
            const auto both = ready->substr(at, ready->find(' ', at) - at);
            const auto comma = both.find(',');
            pairs.try_emplace(name, Pair{endpoint_of(both.substr(0, comma)),
                                         endpoint_of(both.substr(comma + 1))});
        }
    }

    /// Sends one datagram each way, the lower host first, so that the emulator knows both sides.
    void introduce()
    {
        for (auto& [name, pair] : pairs) {
            pair.second.send(pair.listen_2, 1000);
            EXPECT_TRUE(process->wait_for_err(name + ": A is not known yet, B is", 5s));
            pair.first.send(pair.listen_1, 1000);
            EXPECT_TRUE(process->wait_for_err(name + ": A is 127.0.0.1", 5s));
        }
    }

    [[nodiscard]] nlohmann::json ctl(std::vector<std::string> words) const
    {
        words.insert(words.begin(), {"--json", folder.file("s")});
        return nlohmann::json::parse(run("hapnet-ctl", words).out, nullptr, false);
    }

    [[nodiscard]] nlohmann::json stop()
    {
        process->signal(SIGTERM);
        EXPECT_EQ(process->wait_exit(10s), 0) << process->err();
        auto statistics = nlohmann::json::parse(text_of(folder.file("stats.json")));
        for (const auto& [name, link] : statistics["links"].items()) {
            expect_identity(link["up"]);
            expect_identity(link["down"]);
        }
        expect_identity(statistics["up"]);
        expect_identity(statistics["down"]);
        return statistics;
    }

    TemporaryFolder folder;
    std::optional<Process> process;
    std::map<std::string, Pair> pairs;
};

/// Sends `count` datagrams each way through every link.
void stream_through(LinksRunning& emulator, std::uint64_t count)
{
    for (std::uint64_t n = 0; n < count; ++n) {
        for (auto& [name, pair] : emulator.pairs) {
            pair.first.send(pair.listen_1, n);
            pair.second.send(pair.listen_2, n);
        }
        net::sleep_until(net::monotonic_now() + 200us);
    }
}

} // namespace

TEST(EmulatorLinks, KeepThreePairsApart)
{
    LinksRunning emulator{
        {"1-2", "1-3", "wan"},
        {"--delay", "20ms", "--set", "3-1.delay=60ms", "--set", "wan.up.loss=100%", "--seed", "3"}};
    for (auto& [name, pair] : emulator.pairs) pair.second.send(pair.listen_2, 0);
    for (const char* const name : {"1-2", "1-3", "wan"}) {
        EXPECT_TRUE(
            emulator.process->wait_for_err(std::string{name} + ": A is not known yet, B is", 5s));
    }
    for (auto& [name, pair] : emulator.pairs) pair.first.send(pair.listen_1, 1);
    EXPECT_GE(emulator.pairs.at("1-2").second.receive(1, 5s).at(0).delay, 20ms - 4us);
    EXPECT_EQ(emulator.pairs.at("1-3").second.receive(1, 5s).size(), 1U);
    auto& slow = emulator.pairs.at("1-3");
    slow.second.send(slow.listen_2, 2);
    EXPECT_GE(slow.first.receive(1, 5s).at(0).delay, 60ms - 4us);
    auto& wan = emulator.pairs.at("wan");
    wan.second.send(wan.listen_2, 2);
    EXPECT_EQ(wan.first.receive(1, 5s).size(), 1U);
    EXPECT_TRUE(wan.second.arrivals().empty());
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["links"]["1-2"]["up"]["delivered"], 1);
    EXPECT_EQ(statistics["links"]["wan"]["up"]["dropped"]["random_loss"], 1);
    EXPECT_EQ(statistics["links"]["1-3"]["down"]["received"], 2);
    EXPECT_EQ(statistics["up"]["received"], 3);
    EXPECT_EQ(statistics["configuration_at_start"]["down"]["delay"], "20ms");
    const auto& of_slow = statistics["links"]["1-3"];
    EXPECT_EQ(of_slow["configuration_at_start"]["down"]["delay"], "60ms");
    EXPECT_EQ(of_slow["configuration_at_end"], of_slow["configuration_at_start"]);
}

TEST(EmulatorLinks, HaveFatesThatAreDrawnByTheirNamesAndThatCanBeReplayed)
{
    const auto fates_of = [](const std::vector<std::string>& links,
                             const std::vector<std::string>& options) {
        LinksRunning emulator{links, options};
        emulator.introduce();
        stream_through(emulator, 100);
        const std::uint64_t all = 101;
        EXPECT_TRUE(comes_true([&] {
            const auto statistics = emulator.ctl({"stats"});
            return statistics["up"]["received"] == links.size() * all &&
                   statistics["down"]["received"] == links.size() * all;
        }));
        std::ignore = emulator.stop();
        return text_of(options.back());
    };
    TemporaryFolder folder;
    const auto first = folder.file("first.csv");
    const std::vector<std::string> drawn{"--loss", "50%", "--jitter", "1ms",
                                         "--seed", "5",   "--fates"};
    const auto with = [](std::vector<std::string> words, const std::string& word) {
        words.push_back(word);
        return words;
    };
    const auto together =
        parse_fates_of_paths(fates_of({"1-2", "1-3", "wan"}, with(drawn, first))).value();
    EXPECT_EQ(together.size(), 3U);
    EXPECT_NE(together.at("1-2").up, together.at("1-3").up);
    const auto alone =
        parse_fates_of_paths(fates_of({"1-3"}, with(drawn, folder.file("alone.csv")))).value();
    EXPECT_EQ(alone.at("1-3"), together.at("1-3"));
    EXPECT_EQ(
        fates_of({"1-2", "1-3", "wan"}, {"--replay", first, "--fates", folder.file("again.csv")}),
        text_of(first));
    const auto verified = run("hapnet-emulator", {"verify", first, "--link", "1-3", "--seed", "5",
                                                  "--profile", folder.file("none")});
    expect_refusal(verified, 2, {"none"});
    expect_refusal(
        run("hapnet-emulator", {"--listen-a", ":0", "--listen-b", ":0", "--replay", first}), 2,
        {"fates of several paths"});
}

TEST(EmulatorLinks, HaveTheSameFatesInTheSameOrderHoweverManyThreadsRelayThem)
{
    TemporaryFolder folder;
    const auto fates_with = [&](const char* threads) {
        const auto file = folder.file(std::string{threads} + ".csv");
        LinksRunning emulator{{"1-2", "1-3", "2-3", "wan"},
                              {"--loss", "20%", "--jitter", "1ms", "--duplicate", "5%", "--threads",
                               threads, "--pcap", folder.file("run.pcapng"), "--fates", file}};
        emulator.introduce();
        stream_through(emulator, 200);
        EXPECT_TRUE(comes_true([&] {
            const auto statistics = emulator.ctl({"stats"});
            return statistics["up"]["received"] == 4 * 201 &&
                   statistics["down"]["received"] == 4 * 201;
        }));
        const auto statistics = emulator.stop();
        EXPECT_EQ(statistics["fates_lost"], 0);
        EXPECT_EQ(statistics["capture_lost"], 0);
        EXPECT_EQ(statistics["links"].size(), 4U);
        return text_of(file);
    };
    const auto alone = fates_with("1");
    EXPECT_EQ(fates_with("2"), alone);
    EXPECT_EQ(fates_with("4"), alone);
    EXPECT_EQ(fates_with("16"), alone); // four of these paths have a link
}

TEST(EmulatorLinks, OnSeveralThreadsChangeAsOne)
{
    LinksRunning emulator{{"1-2", "2-3", "wan"}, {"--delay", "5ms", "--threads", "3"}};
    emulator.introduce();
    EXPECT_EQ(emulator.ctl({"set", "3-2.delay", "50ms"})["generation"], 2);
    const auto changed = emulator.ctl({"set", "wan.up.delay", "60ms", "all.mtu", "1500B"});
    EXPECT_EQ(changed["generation"], 3) << changed;
    EXPECT_EQ(changed["effective_at"].size(), 3U);
    EXPECT_EQ(changed["effective_at"]["2-3"]["down"], 1);
    EXPECT_EQ(emulator.ctl({"set", "wan.up.delay", "60ms"})["changed"], false);
    auto& pair = emulator.pairs.at("2-3");
    pair.second.send(pair.listen_2, 1);
    EXPECT_GE(pair.first.receive(1, 5s).back().delay, 50ms - 4us);
    auto& wan = emulator.pairs.at("wan");
    wan.first.send(wan.listen_1, 2);
    EXPECT_GE(wan.second.receive(2, 5s).back().delay, 60ms - 4us);
    const auto shown = run("hapnet-ctl", {emulator.folder.file("s"), "show"});
    EXPECT_NE(shown.out.find("[link.\"3-2\"]"), std::string::npos) << shown.out;
    EXPECT_NE(shown.out.find("[link.\"wan\".up]"), std::string::npos) << shown.out;
    stream_through(emulator, 300); // while the statistics are asked for again and again
    const auto watched = run("hapnet-ctl", {emulator.folder.file("s"), "wait", "--until",
                                            "up.delivered>=900", "--timeout", "10s"});
    EXPECT_EQ(watched.exit, 0) << watched.err;
    EXPECT_EQ(emulator.ctl({"reset"})["generation"], 4);
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["generation"], 4);
    for (const char* link : {"1-2", "2-3", "wan"}) {
        EXPECT_EQ(statistics["links"][link]["configuration_at_end"]["up"]["delay"], "5ms") << link;
    }
}

TEST(EmulatorLinks, ChangeTogetherOrOneByOneOverTheControlSocketAndAreWatchedThere)
{
    LinksRunning emulator{{"1-2", "2-3"}, {"--delay", "5ms"}};
    emulator.introduce();
    const auto changed = emulator.ctl({"set", "3-2.delay", "50ms", "all.mtu", "1500B"});
    EXPECT_EQ(changed["generation"], 2) << changed;
    EXPECT_EQ(changed["effective_at"]["2-3"]["down"], 1);
    auto& pair = emulator.pairs.at("2-3");
    pair.second.send(pair.listen_2, 1);
    EXPECT_GE(pair.first.receive(1, 5s).back().delay, 50ms - 4us);
    const auto waited = run("hapnet-ctl", {emulator.folder.file("s"), "wait", "--until",
                                           "links.2-3.down.delivered>=1", "--timeout", "10s"});
    EXPECT_EQ(waited.exit, 0) << waited.err;
    const auto shown = run("hapnet-ctl", {emulator.folder.file("s"), "show"});
    EXPECT_NE(shown.out.find("[link.\"3-2\"]"), std::string::npos) << shown.out;
    EXPECT_EQ(run("hapnet-ctl", {emulator.folder.file("s"), "set", "1-3.delay", "1ms"}).exit, 2);
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["generation"], 2);
    const auto& link = statistics["links"]["2-3"];
    ASSERT_EQ(link["changes"].size(), 1U);
    EXPECT_EQ(link["changes"][0]["by"], "hand");
    EXPECT_EQ(link["changes"][0]["effective_at"]["down"], 1);
    EXPECT_EQ(link["changes"][0]["settings"],
              (nlohmann::json{{"2-3.mtu", "1500B"}, {"3-2.delay", "50ms"}, {"3-2.mtu", "1500B"}}));
    EXPECT_EQ(link["configuration_at_end"]["down"]["delay"], "50ms");
    EXPECT_FALSE(statistics["links"]["1-2"]["changes"][0]["settings"].contains("2-1.delay"));
}

TEST(EmulatorLinks, AreCheckedVerifiedAndReportedOneByOne)
{
    TemporaryFolder folder;
    LinksRunning emulator{{"1-2", "1-3"},
                          {"--loss", "20%", "--set", "1-3.jitter=1ms", "--seed", "5", "--fates",
                           folder.file("fates.csv"), "--require", "links.1-3.up.received>=301",
                           "--require", "links.1-2.up.received<1"}};
    emulator.introduce();
    stream_through(emulator, 300);
    EXPECT_TRUE(comes_true([&] { return emulator.ctl({"stats"})["up"]["received"] == 602; }));
    EXPECT_TRUE(comes_true([&] { return emulator.ctl({"stats"})["down"]["received"] == 602; }));
    EXPECT_EQ(run("hapnet-ctl", {emulator.folder.file("s"), "stop"}).exit, 0);
    EXPECT_EQ(emulator.process->wait_exit(10s), 1) << emulator.process->err();
    EXPECT_NE(emulator.process->err().find("NOT MET: links.1-2.up.received<1"), std::string::npos);
    EXPECT_EQ(emulator.process->err().find("NOT MET: links.1-3"), std::string::npos);
    const auto stats = emulator.folder.file("stats.json");
    const auto page = folder.file("run.html");
    const auto reported = run("hapnet-emulator", {"report", stats, "--link", "1-3", "--out", page});
    EXPECT_EQ(reported.exit, 0) << reported.err;
    EXPECT_NE(text_of(page).find("An emulated path, 1-3"), std::string::npos);
    EXPECT_NE(text_of(page).find("up: seed"), std::string::npos) << text_of(page);
    EXPECT_EQ(run("hapnet-emulator", {"verify", stats, "--link", "1-3"}).exit, 0);
    expect_refusal(run("hapnet-emulator", {"report", stats, "--out", page}), 2,
                   {"name one with --link", "1-2, 1-3"});
    expect_refusal(run("hapnet-emulator", {"report", stats, "--link", "2-3", "--out", page}), 2,
                   {"has no path '2-3'"});
}

TEST(EmulatorLinks, AreNeverOpenAndNeverSendToThemselves)
{
    const auto refused = [](const std::vector<std::string>& words, const std::string& why) {
        expect_refusal(run("hapnet-emulator", words), 2, {why});
    };
    refused({"--link", "1-2=0.0.0.0:0,127.0.0.1:0"}, "--link 1-2: END_A HOST:PORT");
    refused({"--link", "1-2=127.0.0.1:9101,127.0.0.1:9102,127.0.0.1:9104,", "--link",
             "1-3=127.0.0.1:9103,127.0.0.1:9104"},
            "where the emulator itself listens");
    TemporaryFolder folder;
    LinksRunning emulator{{"1-2", "1-3"}, {"--profile", "lte"}};
    emulator.introduce();
    Host stranger;
    auto& pair = emulator.pairs.at("1-3");
    stranger.send(pair.listen_1, 1);
    EXPECT_TRUE(emulator.process->wait_for_err("sends to LISTEN_A of --link 1-3", 5s));
    EXPECT_EQ(emulator.stop()["links"]["1-3"]["up"]["strangers"], 1);
}

} // namespace hapnet::e2e
