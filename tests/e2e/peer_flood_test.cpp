// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Meaningless datagrams at a peer's socket, from strangers and from the other peer's address.
#include "proto/base/random.hpp"
#include "proto/wire/message.hpp"
#include "tests/e2e/peer.hpp"
#include "tests/e2e/udp.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t datagrams = 100'000;

/// Random bytes of a random length. Half of them start like a state message. None starts like a
/// message of another version, which would rightly end a peer that waits.
std::vector<std::byte> nonsense(const base::RandomStream& stream, std::uint64_t number)
{
    const bool like_ours = number % 4 < 2;
    const std::size_t size = like_ours ? (number % 4 == 0 ? 86 : 136) : stream.below(300, number);
    std::vector<std::byte> bytes(size);
    for (std::size_t i = 0; i < size; i += 8) {
        const std::uint64_t bits = stream.bits(number, static_cast<std::uint32_t>(i + 1));
        for (std::size_t j = 0; j < 8 && i + j < size; ++j) {
            bytes[i + j] = static_cast<std::byte>(bits >> (8 * j));
        }
    }
    if (like_ours) {
        bytes[0] = std::byte{'H'};
        bytes[1] = std::byte{'N'};
        bytes[2] = std::byte{wire::protocol_version};
        bytes[3] = std::byte{2};
    } else if (size > 0) {
        bytes[0] = std::byte{0};
    }
    return bytes;
}

std::uint64_t count(const nlohmann::json& messages, const char* key)
{
    return messages[key].get<std::uint64_t>();
}

} // namespace

TEST(PeerFlood, OfRandomAndMutatedDatagramsIsCountedAndHarmless)
{
    Host remote;
    Host stranger;
    const std::string place = free_place();
    Peer peer{1, place, remote.endpoint().to_text(), {}};
    const auto target = endpoint_of(place);
    const auto stream = base::Seed{1}.stream("flood");
    const auto begun = std::chrono::steady_clock::now();
    for (std::uint64_t number = 0; number < datagrams; ++number) {
        Host& from = number / 100 % 2 == 0 ? remote : stranger;
        from.send_bytes(target, nonsense(stream, number));
        // Slower than the peer reads, or its socket would overflow: that is counted as well.
        if (number % 100 == 99) std::this_thread::sleep_for(1ms);
    }
    std::this_thread::sleep_for(200ms);
    stranger.send_bytes(target, nonsense(stream, 0)); // brings the overflow count up to date
    std::this_thread::sleep_for(200ms);
    EXPECT_EQ(peer.process().wait_exit(0ms), std::nullopt) << peer.process().err();
    peer.stop();

    const auto messages = peer.statistics()["messages"];
    const std::uint64_t seen = count(messages, "strangers") + count(messages, "malformed") +
                               count(messages, "other_session") + count(messages, "overflowed");
    EXPECT_EQ(seen, datagrams + 1) << messages;
    EXPECT_GT(count(messages, "strangers"), datagrams / 4) << messages;
    EXPECT_GT(count(messages, "malformed"), datagrams / 4) << messages;
    EXPECT_EQ(count(messages, "states_received"), 0U);
    // The record takes 2000 messages without effect per second, and a second of them at once.
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    const double recorded = 2000.0 * (took.count() + 1.0);
    const double heard =
        static_cast<double>(count(messages, "malformed") + count(messages, "other_session"));
    EXPECT_GE(peer.statistics()["record_rows_lost"].get<double>(), heard - recorded) << messages;
}

TEST(PeerFlood, ByStrangersDoesNotEnterASession)
{
    const std::string place_a = free_place();
    const std::string place_b = free_place();
    const std::vector<std::string> options{"--task", "T3", "--duration", "120s"};
    Peer a{1, place_a, place_b, options};
    Peer b{2, place_b, place_a, options};
    EXPECT_TRUE(a.says("session started"));
    Host stranger;
    const auto stream = base::Seed{2}.stream("flood");
    for (std::uint64_t number = 0; number < 20'000; ++number) {
        stranger.send_bytes(endpoint_of(place_a), nonsense(stream, number));
        if (number % 50 == 49) std::this_thread::sleep_for(1ms);
    }
    a.stop();
    EXPECT_TRUE(b.says("goodbye"));
    b.stop();
    const auto messages = a.statistics()["messages"];
    EXPECT_GT(count(messages, "strangers"), 10'000U);
    EXPECT_GT(count(messages, "states_received"), 100U);
    EXPECT_EQ(count(messages, "malformed"), 0U);
}

} // namespace hapnet::e2e
