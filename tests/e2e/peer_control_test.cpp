// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Two peers in a session, queried and stopped with hapnet-ctl and over their sockets.
#include "proto/net/unix_socket.hpp"
#include "tests/e2e/peer.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <sys/stat.h>
#include <thread>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;
using nlohmann::json;

struct ControlledPeers : testing::Test {
    /// Starts both peers. Peer 1 has the socket.
    void begin()
    {
        const std::vector<std::string> task{"--task", "T3", "--duration", "120s"};
        std::vector<std::string> options = task;
        options.insert(options.end(), {"--control", socket});
        const std::string place = free_place();
        const std::string other = free_place();
        a.emplace(1, place, other, options);
        b.emplace(2, other, place, task);
    }

    [[nodiscard]] Outcome ctl(std::vector<std::string> words) const
    {
        words.insert(words.begin(), socket);
        return run("hapnet-ctl", words);
    }

    [[nodiscard]] json asked(std::vector<std::string> words) const
    {
        words.insert(words.begin(), "--json");
        const auto outcome = ctl(words);
        EXPECT_EQ(outcome.exit, 0) << outcome.err;
        auto reply = json::parse(outcome.out, nullptr, false);
        EXPECT_TRUE(reply.is_object()) << outcome.out;
        return reply.is_object() ? reply : json::object();
    }

    void wait_until_they_push() const
    {
        const auto met = asked({"wait", "--until", "messages.states_received>0"});
        EXPECT_EQ(met["met"], true);
        EXPECT_TRUE(comes_true([&] { return asked({"show"}).value("force_n", 0.0) >= 0.1; }));
    }

    TemporaryFolder folder;
    std::string socket = folder.file("peer.sock");
    std::optional<Peer> a;
    std::optional<Peer> b;
};

/// Returns every key, with the keys of nested objects.
std::vector<std::string> keys_of(const json& object, const std::string& path = "")
{
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) {
        keys.push_back(path + key);
        if (!value.is_object()) continue;
        const auto inner = keys_of(value, path + key + ".");
        keys.insert(keys.end(), inner.begin(), inner.end());
    }
    return keys;
}

/// Clients that break every rule, until this object ends.
class RudeClients {
public:
    explicit RudeClients(const std::string& path) : thread_{[this, path] { be_rude(path); }} {}
    ~RudeClients()
    {
        over_ = true;
        thread_.join();
    }
    RudeClients(const RudeClients&) = delete;
    RudeClients& operator=(const RudeClients&) = delete;

private:
    static constexpr int at_a_time = 12; // leaves places for well-behaved clients

    void be_rude(const std::string& path)
    {
        std::string requests; // whose answers are never read
        for (int i = 0; i < 100; ++i) requests += "{\"command\":\"stats\"}\n";
        const std::array<std::string, 4> words{requests, std::string(1'000'000, 'x'),
                                               std::string(15'000, '[') + "\n",
                                               "{\"command\":\"stop\""};
        std::vector<net::UnixStream> streams;
        for (int i = 0; i < at_a_time; ++i) streams.push_back(net::UnixStream::connect(path));
        while (!over_) {
            for (std::size_t i = 0; i < streams.size(); ++i) {
                const auto sent = streams[i].write(words[i % words.size()]);
                if (sent.state != net::Transfer::State::gone) continue;
                streams[i] = net::UnixStream::connect(path);
            }
            std::this_thread::sleep_for(1ms);
        }
    }

    std::atomic<bool> over_{false};
    std::thread thread_;
};

/// True if a loop kept time between two answers at least two seconds apart. Without FIFO the
/// clients take its core from it. With FIFO it may miss ten times as many ticks as a measurement,
/// and its governor must have seen no fault.
bool kept_time(const json& before, const json& after)
{
    const auto since = [&](const char* key) {
        return after["tick"][key].get<double>() - before["tick"][key].get<double>();
    };
    if (since("count") < 1000.0) return false;
    if (after["real_time"]["fifo"] != true) return true;
    return since("missed") < 10 * 0.005 * since("count") &&
           after["governor"]["watchdog_halts"] == before["governor"]["watchdog_halts"] &&
           after["governor"]["fault"] == "none";
}

} // namespace

TEST_F(ControlledPeers, SayHowTheyAreWhileTheyPush)
{
    begin();
    wait_until_they_push();
    const auto shown = asked({"show"});
    EXPECT_EQ(shown["peer_id"], 1);
    EXPECT_EQ(shown["task"], "T3");
    EXPECT_EQ(shown["scene"], "paper");
    EXPECT_EQ(shown["algorithm"], "base");
    EXPECT_EQ(shown["duration_s"], 120.0);
    EXPECT_EQ(shown["state"], "running");
    EXPECT_EQ(shown["says"], "in session");
    EXPECT_EQ(shown["session"]["role"], "L");
    EXPECT_EQ(shown["fault"], nullptr);
    EXPECT_NE(ctl({"show"}).out.find("s ago, running: in session\n"), std::string::npos);

    auto live = asked({"stats"});
    EXPECT_GT(live["messages"]["states_received"], 0);
    EXPECT_GT(live["elapsed_s"], 1.0);
    EXPECT_TRUE(
        comes_true([&] { return asked({"stats"})["tick"]["count"] > live["tick"]["count"]; }));
    a->stop();
    live.erase("ok");
    live.erase("elapsed_s");
    EXPECT_EQ(keys_of(live), keys_of(a->statistics()));
    b->stop();
}

TEST_F(ControlledPeers, EndInZeroForceWithTheirStatisticsWhenTheyAreStopped)
{
    begin();
    wait_until_they_push();
    EXPECT_EQ(asked({"stop"}), (json{{"ok", true}, {"stopping", true}}));
    a->expect_end();
    EXPECT_TRUE(b->says("the other peer said goodbye"));
    b->stop();
    EXPECT_GT(a->statistics()["messages"]["states_sent"], 0);
    const auto ticks = ticks_of(a->record());
    ASSERT_FALSE(ticks.empty());
    EXPECT_TRUE(std::any_of(ticks.begin(), ticks.end(),
                            [](const Tick& tick) { return tick.force_n > 0.0; }));
    EXPECT_EQ(ctl({"show"}).exit, 3);
    EXPECT_TRUE(folder.names().empty()) << "the socket has gone with the peer";
}

TEST_F(ControlledPeers, AreNotChangedByAnybody)
{
    begin();
    for (const auto& words : std::vector<std::vector<std::string>>{{"set", "both.delay", "80ms"},
                                                                   {"reset"},
                                                                   {"apply", "/dev/null"},
                                                                   {"diff", "/dev/null"}}) {
        const auto outcome = ctl(words);
        EXPECT_EQ(outcome.exit, 2) << words[0];
        EXPECT_NE(outcome.err.find("is for an emulator"), std::string::npos) << outcome.err;
    }
    const auto wrong = ctl({"wait", "--until", "up.received>0"});
    EXPECT_EQ(wrong.exit, 2);
    EXPECT_NE(wrong.err.find("there is no 'up'"), std::string::npos) << wrong.err;
    EXPECT_EQ(ctl({"wait", "--until", "tick.count<0", "--timeout", "200ms"}).exit, 1);

    Process watching{"hapnet-ctl", {socket, "watch", "--every", "50ms"}};
    EXPECT_TRUE(watching.wait_for_out("received_per_s=", 5s)) << watching.err();
    watching.signal(SIGINT);
    EXPECT_EQ(watching.wait_exit(5s), 0);
}

TEST_F(ControlledPeers, OwnTheirSocketsAlone)
{
    begin();
    struct stat found {};
    ASSERT_EQ(stat(socket.c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777U, 0600U);
    const auto second = run("hapnet-peer", {"--remote", "127.0.0.1:9", "--control", socket});
    EXPECT_EQ(second.exit, 3);
    EXPECT_NE(second.err.find(socket), std::string::npos) << second.err;
    EXPECT_EQ(asked({"show"})["peer_id"], 1);
    a->kill();
    EXPECT_TRUE(std::filesystem::exists(socket));
    a->restart();
    EXPECT_EQ(asked({"show"})["peer_id"], 1);
}

TEST_F(ControlledPeers, KeepTimeWhileClientsAreRude)
{
    // The hypervisor may take both cores for some milliseconds at any time, which ends a session at
    // zero force. An effect of the clients would show in every session.
    bool keeps_time = false;
    std::string reports;
    for (int session = 0; session < 5 && !keeps_time; ++session) {
        begin();
        wait_until_they_push();
        const json before = asked({"stats"});
        {
            const RudeClients clients{socket};
            std::this_thread::sleep_for(2s);
            EXPECT_EQ(asked({"show"})["state"], "running");
            EXPECT_TRUE(asked({"stats"}).contains("tick"));
        }
        const json after = asked({"stats"});
        keeps_time = kept_time(before, after);
        reports += after["tick"].dump() + after["governor"].dump() + "\n";
        a->stop_on_a_busy_machine();
    }
    EXPECT_TRUE(keeps_time) << reports;
}

} // namespace hapnet::e2e
