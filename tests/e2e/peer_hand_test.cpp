// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A peer with the hand of a page, moved over its control socket.
#include "proto/net/unix_socket.hpp"
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/peer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <thread>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;
using nlohmann::json;

/// A client that keeps its connection, as a page does.
class Client {
public:
    explicit Client(const std::string& path) : stream_{net::UnixStream::connect(path)} {}

    json ask(const std::string& line)
    {
        static_cast<void>(stream_.write(line + "\n"));
        return json::parse(heard(stream_), nullptr, /*allow_exceptions*/ false);
    }
    json hand(double x, double y = 0.0, double z = 0.0)
    {
        return ask(fmt::format(R"({{"command":"hand","x":{},"y":{},"z":{}}})", x, y, z));
    }

private:
    net::UnixStream stream_;
};

struct PeersWithAPage : testing::Test {
    void begin()
    {
        const std::vector<std::string> task{"--task", "T1", "--duration", "60s"};
        const auto with = [&task](std::vector<std::string> more) {
            more.insert(more.begin(), task.begin(), task.end());
            return more;
        };
        const std::string place = free_place();
        const std::string other = free_place();
        a.emplace(1, place, other, with({"--device", "page", "--control", page}));
        b.emplace(2, other, place, with({"--control", simulated}));
        const auto in_session = [&] {
            return answer_of(page, "show").value("phase", "") == "running";
        };
        ASSERT_TRUE(comes_true(in_session));
    }

    TemporaryFolder folder;
    std::string page = folder.file("a.sock");
    std::string simulated = folder.file("b.sock");
    std::optional<Peer> a;
    std::optional<Peer> b;
};

TEST_F(PeersWithAPage, MoveItByHandAndNoOtherDevice)
{
    begin();
    Client client{page};
    EXPECT_EQ(Client{simulated}.hand(0.0)["error"],
              "'hand' moves the hand of --device page, and this peer has another device");
    EXPECT_EQ(client.hand(0.3)["ok"], false);
    EXPECT_EQ(client.ask(R"({"command":"hand","x":1e999,"y":0,"z":0})")["ok"], false);
    EXPECT_EQ(client.ask(R"({"command":"hand","x":0})")["ok"], false);
    // At once from one side to the other, twice, then held against the cube for a second.
    for (const double x : {-0.2, -0.05, -0.2}) {
        for (int i = 0; i < 20; ++i) {
            EXPECT_EQ(client.hand(x), (json{{"ok", true}}));
            std::this_thread::sleep_for(10ms);
        }
    }
    for (int i = 0; i < 50; ++i) {
        EXPECT_EQ(client.hand(0.0), (json{{"ok", true}}));
        std::this_thread::sleep_for(20ms);
    }
    std::this_thread::sleep_for(600ms); // without a place, the hand is released
    a->stop();
    b->stop();

    const std::vector<Tick> ticks = ticks_of(a->record());
    double fastest_mm_per_s = 0.0;
    double most_n = 0.0;
    std::optional<double> held_last_s;
    for (std::size_t i = 1; i < ticks.size(); ++i) {
        const Tick& before = ticks[i - 1];
        const Tick& now = ticks[i];
        const double far =
            std::hypot(now.hip_mm[0] - before.hip_mm[0], now.hip_mm[1] - before.hip_mm[1],
                       now.hip_mm[2] - before.hip_mm[2]);
        fastest_mm_per_s = std::max(fastest_mm_per_s, far / (now.time_s - before.time_s));
        most_n = std::max(most_n, now.force_n);
        if (!now.docked) held_last_s = now.time_s;
    }
    // Times of a record are of microseconds and more, places of nanometres.
    EXPECT_GT(fastest_mm_per_s, 900.0);
    EXPECT_LE(fastest_mm_per_s, 1000.0 * 1.01);
    EXPECT_GT(most_n, 0.1) << "it pushed the cube";
    EXPECT_LE(most_n, 3.3 + 1e-6) << "the governor's limit holds";
    ASSERT_TRUE(held_last_s);
    EXPECT_GT(ticks.back().time_s - *held_last_s, 0.2) << "it was let go";
    EXPECT_TRUE(ticks.front().docked) << "no hand holds it at first";
    EXPECT_EQ(ticks.back().force_n, 0.0);
}

} // namespace

} // namespace hapnet::e2e
