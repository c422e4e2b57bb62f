// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Three daemons through one emulator that has a link for every two of them.
#include "tests/e2e/peer.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

constexpr std::array ids{1, 2, 3};

/// An emulator with the links 1-2, 1-3 and 2-3, and three peers that carry the cube (T7).
class ThreePeers {
public:
    ThreePeers(const std::vector<std::string>& conditions, std::string duration, bool keyed)
        : duration_{std::move(duration)}
    {
        std::vector<std::string> words{"--link", "1-2=127.0.0.1:0,127.0.0.1:0",
                                       "--link", "1-3=127.0.0.1:0,127.0.0.1:0",
                                       "--link", "2-3=127.0.0.1:0,127.0.0.1:0"};
        words.insert(words.end(), conditions.begin(), conditions.end());
        emulator_.emplace("hapnet-emulator", words);
        const auto ready = emulator_->wait_for_out("ready ", 10s);
        EXPECT_TRUE(ready) << emulator_->err();
        if (ready) read_places(*ready);
        if (keyed) {
            const auto made =
                run("hapnet-peer", {"keygen", "--peers", "3", "--out", folder.file("keys")});
            EXPECT_EQ(made.exit, 0) << made.err;
            keys_ = folder.file("keys/peer-");
        }
        for (const int id : ids) listens_[id] = free_place();
        for (const int id : ids) start(id, "first");
    }

    /// Starts a new run of a peer, with its own record.
    void start(int id, const std::string& name)
    {
        std::vector<std::string> words{
            "--id",    std::to_string(id), "--listen",  listens_[id], "--task",
            "t7",      "--duration",       duration_,   "--record",   record(id, name),
            "--stats", stats(id, name),    "--control", socket(id)};
        for (const int other : ids) {
            if (other == id) continue;
            words.insert(words.end(),
                         {"--peer", std::to_string(other) + "=" + places_[{id, other}]});
        }
        if (keys_) words.insert(words.end(), {"--key", *keys_ + std::to_string(id) + ".key"});
        peers_[id].emplace("hapnet-peer", words);
        EXPECT_TRUE(peers_[id]->wait_for_out("ready ", 10s)) << peers_[id]->err();
    }
    void kill(int id)
    {
        peers_[id]->signal(SIGKILL);
        EXPECT_EQ(peers_[id]->wait_exit(5s), 128 + SIGKILL);
    }
    void says(int id, const std::string& words)
    {
        EXPECT_TRUE(peers_[id]->wait_for_err(words, 30s))
            << id << ", expected: " << words << "\nbut said:\n"
            << peers_[id]->err();
    }
    void expect_end()
    {
        for (const int id : ids) EXPECT_EQ(peers_[id]->wait_exit(60s), 0) << peers_[id]->err();
    }

    [[nodiscard]] nlohmann::json show(int id) const { return answer_of(socket(id), "show"); }
    [[nodiscard]] std::string record(int id, const std::string& name) const
    {
        return folder.file(name + "-" + std::to_string(id) + ".rec");
    }
    [[nodiscard]] std::string stats(int id, const std::string& name) const
    {
        return folder.file(name + "-" + std::to_string(id) + ".json");
    }
    [[nodiscard]] nlohmann::json statistics(int id, const std::string& name) const
    {
        return nlohmann::json::parse(text_of(stats(id, name)), nullptr, false);
    }

    TemporaryFolder folder;

private:
    [[nodiscard]] std::string socket(int id) const
    {
        return folder.file(std::to_string(id) + ".sock");
    }
    /// "ready 1-2=ADDRESS,ADDRESS ...": the address to which each peer sends for each other.
    void read_places(const std::string& ready)
    {
        for (const int low : ids) {
            for (const int high : ids) {
                const auto name = " " + std::to_string(low) + "-" + std::to_string(high) + "=";
                const auto at = ready.find(name);
                if (at == std::string::npos) continue;
                const auto both =
                    ready.substr(at + name.size(), ready.find(' ', at + 1) - at - name.size());
                places_[{low, high}] = both.substr(0, both.find(','));
                places_[{high, low}] = both.substr(both.find(',') + 1);
            }
        }
    }

    std::string duration_;
    std::optional<std::string> keys_;
    std::optional<Process> emulator_;
    std::map<std::pair<int, int>, std::string> places_;
    std::map<int, std::string> listens_;
    std::map<int, std::optional<Process>> peers_;
};

/// Analyses the records of all three with `hapnet-lab analyse`.
nlohmann::json analysis_of_three(const std::array<std::string, 3>& records)
{
    const Outcome analysed =
        run("hapnet-lab", {"analyse", records[0], records[1], records[2], "--json"}, 60s);
    EXPECT_EQ(analysed.exit, 0) << analysed.err;
    auto json = nlohmann::json::parse(analysed.out, nullptr, /*exceptions*/ false);
    EXPECT_TRUE(json.is_object()) << analysed.out;
    return json.is_object() ? json : nlohmann::json::object();
}

void expect_copies_agree(const nlohmann::json& analysis)
{
    ASSERT_TRUE(analysis["settled_discrepancy_mm"].is_number()) << analysis.dump(2);
    EXPECT_LE(analysis["settled_discrepancy_mm"].get<double>(), 0.1);
    for (const char* pair : {"1-2", "1-3", "2-3"}) {
        const auto& of_pair = analysis["pairs"][pair];
        EXPECT_LE(of_pair["settled_discrepancy_mm"].get<double>(),
                  analysis["settled_discrepancy_mm"].get<double>());
        EXPECT_GE(of_pair["a_to_b"]["delay_ms"]["p50"].get<double>(), 20.0) << pair;
        EXPECT_GT(of_pair["b_to_a"]["received"].get<int>(), 1000) << pair;
    }
    for (const int id : ids)
        EXPECT_TRUE(analysis["peers"].contains(std::to_string(id))) << analysis.dump(2);
}

} // namespace

TEST(PeerCircle, CarriesTheCubeAndPlaysOnWhenOneIsKilledAndComesBack)
{
    ThreePeers three{{"--delay", "20ms", "--loss", "10%"}, "16s", false};
    for (const int id : ids) three.says(id, "session started");
    for (const int id : ids) {
        EXPECT_TRUE(comes_true([&] { return three.show(id).value("force_n", 0.0) > 0.05; }));
    }
    three.kill(3);
    for (const int id : {1, 2}) three.says(id, "peer 3 has been silent for 300 ms");
    for (const int id : {1, 2}) { // the other two push on without it
        EXPECT_TRUE(comes_true([&] { return three.show(id).value("force_n", 0.0) > 0.05; }));
        EXPECT_EQ(three.show(id)["others"][1]["heard"], false);
    }
    three.start(3, "second");
    three.says(3, "joined the session under way");
    for (const int id : {1, 2}) three.says(id, "peer 3 was restarted");
    three.expect_end();

    expect_copies_agree(analysis_of_three(
        {three.record(1, "first"), three.record(2, "first"), three.record(3, "second")}));
    for (const int id : ids) {
        const std::string name = id == 3 ? "second" : "first";
        expect_the_same_forces_again(three.record(id, name));
        const auto statistics = three.statistics(id, name);
        EXPECT_EQ(statistics["others"].size(), 2U);
        EXPECT_EQ(statistics["record_rows_lost"], 0);
        EXPECT_EQ(statistics["messages"]["strangers"], 0);
    }
}

TEST(PeerCircle, SealsWhatItSaysToEachWithAKeyOfTheTwo)
{
    ThreePeers three{{"--delay", "20ms", "--loss", "10%"}, "6s", true};
    for (const int id : ids) three.says(id, "session started");
    three.expect_end();
    expect_copies_agree(analysis_of_three(
        {three.record(1, "first"), three.record(2, "first"), three.record(3, "first")}));
    for (const int id : ids) {
        expect_the_same_forces_again(three.record(id, "first"));
        const auto statistics = three.statistics(id, "first");
        for (const auto& other : statistics["others"]) {
            EXPECT_EQ(other["secure"]["agreed"], true);
            EXPECT_EQ(other["secure"]["handshakes"], 1);
            for (const char* trouble :
                 {"forged", "unsealed", "unknown_key", "other_circle", "misnamed"})
                EXPECT_EQ(other["secure"][trouble], 0) << trouble;
        }
        EXPECT_EQ(statistics["secure"]["handshakes"], 2);
    }
}

TEST(PeerCircle, StartsWhenThoseAreThereThatItWaitsForAndTheLastJoinsLate)
{
    const std::string at_1 = free_place(), at_2 = free_place(), at_3 = free_place();
    const TemporaryFolder folder;
    const auto words = [&](int id) {
        const std::array places{at_1, at_2, at_3};
        std::vector<std::string> all{"--id",       std::to_string(id),
                                     "--listen",   places.at(static_cast<std::size_t>(id - 1)),
                                     "--task",     "t7",
                                     "--duration", "5s",
                                     "--wait-for", "2"};
        for (const int other : ids) {
            if (other == id) continue;
            all.insert(all.end(), {"--peer", std::to_string(other) + "=" +
                                                 places.at(static_cast<std::size_t>(other - 1))});
        }
        return all;
    };
    Process first{"hapnet-peer", words(1)};
    Process second{"hapnet-peer", words(2)};
    EXPECT_TRUE(first.wait_for_err("session started", 30s)) << first.err();
    Process third{"hapnet-peer", words(3)};
    EXPECT_TRUE(third.wait_for_err("joined the session under way", 30s)) << third.err();
    EXPECT_TRUE(first.wait_for_err("peer 3 answers", 30s)) << first.err();
    for (Process* peer : {&first, &second, &third}) EXPECT_EQ(peer->wait_exit(60s), 0);
}

} // namespace hapnet::e2e
