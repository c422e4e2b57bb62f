// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/line/lines.hpp"

#include "proto/secure/key_file.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <map>
#include <utility>
#include <vector>

namespace hapnet::peer::line {

namespace {

using namespace std::chrono_literals;

secure::Place place_of_peer(std::size_t number)
{
    secure::Place place{};
    place[0] = static_cast<std::byte>(number);
    return place;
}

secure::Secret drawn(std::uint8_t number)
{
    secure::Secret secret;
    std::ranges::fill(secret.bytes(), std::byte{number});
    return secret;
}

/// The lines of peer `id`, one of three, to the others.
Lines keyed_lines(std::uint8_t id, std::uint32_t run)
{
    secure::prepare();
    secure::Entropy entropy{drawn(7)};
    const auto files = secure::make_circle("test", 3, entropy);
    const secure::KeyFile& own = files.at(id - 1U);
    std::vector<Line> lines;
    for (const secure::KeyFile::Member& other : own.others) {
        secure::Association::Config config;
        config.own_id = id;
        config.other_id = other.id;
        config.circle = own.circle();
        config.run = run;
        config.place = place_of_peer(other.id);
        lines.emplace_back(std::make_unique<Sealed>(
            config, own.keys_with(other), drawn(static_cast<std::uint8_t>(run + other.id))));
    }
    return Lines{std::move(lines)};
}

/// The hello of peer `id`, one of three, to each of the others.
wire::Datagram hello_of_peer(std::uint16_t id, std::uint32_t run)
{
    wire::Hello hello;
    hello.nonce = run;
    hello.peer_id = id;
    hello.tick_rate_hz = 1000;
    hello.task = wire::TaskName::from_text("T7").value();
    return wire::encode(hello);
}

/// Three peers with keys, 1 ms apart. All messages come from an unknown address.
struct Triple {
    struct Letter {
        std::size_t to = 0;
        std::vector<std::byte> bytes;
    };

    void step(bool says_hello)
    {
        now += 1ms;
        for (const Letter& letter : std::exchange(on_the_way, {})) {
            const auto opened = peers[letter.to].open(letter.bytes, place_of_peer(99), now);
            if (opened) ++heard[{letter.to, opened->from}];
        }
        for (std::size_t from = 0; from < peers.size(); ++from) {
            peers[from].tick({now, now.time_since_epoch().count()});
            for (std::size_t line = 0; line < 2; ++line) {
                bool is_said = !says_hello;
                peers[from][line].send_all(
                    [&]() -> std::optional<wire::Datagram> {
                        if (std::exchange(is_said, true)) return std::nullopt;
                        return hello_of_peer(static_cast<std::uint16_t>(from + 1),
                                             static_cast<std::uint32_t>(10 * (from + 1)));
                    },
                    [&](std::span<const std::byte> bytes, const secure::Place&) {
                        on_the_way.push_back(
                            {line < from ? line : line + 1, {bytes.begin(), bytes.end()}});
                    },
                    now);
            }
        }
    }
    void run(base::Duration time, bool says_hello = false)
    {
        for (const auto end = now + time; now < end;) step(says_hello);
    }

    base::TimePoint now{1000s};
    std::array<Lines, 3> peers{keyed_lines(1, 10), keyed_lines(2, 20), keyed_lines(3, 30)};
    std::vector<Letter> on_the_way;
    std::map<std::pair<std::size_t, std::size_t>, int> heard; // by whom, on which line
};

} // namespace

TEST(Lines, WithoutKeysKnowTheOthersByTheirPlacesAndCountStrangersOnce)
{
    std::vector<Line> plain;
    for (const std::size_t other : {2U, 3U, 5U}) plain.emplace_back(place_of_peer(other));
    Lines lines{std::move(plain)};
    const std::vector<std::byte> any(86, std::byte{3});
    for (const auto& [place, line] : {std::pair{2U, 0U}, {3U, 1U}, {5U, 2U}}) {
        const auto opened = lines.open(any, place_of_peer(place), {});
        ASSERT_TRUE(opened);
        EXPECT_EQ(opened->from, line);
        EXPECT_EQ(opened->message.data(), any.data());
    }
    EXPECT_FALSE(lines.open(any, place_of_peer(4), {}));
    EXPECT_EQ(lines.strangers(), 1U);
    EXPECT_FALSE(lines.are_sealed());
}

TEST(Lines, WithKeysKnowTheOthersByTheirKeysWhereverTheyAre)
{
    Triple triple;
    triple.run(300ms); // each pair has exchanged messages
    for (std::size_t peer = 0; peer < 3; ++peer) {
        for (std::size_t line = 0; line < 2; ++line) {
            EXPECT_EQ(triple.peers.at(peer)[line].news(), News::sealed) << peer << ' ' << line;
            EXPECT_EQ(triple.peers.at(peer)[line].sealed()->counts().other_circle, 0U);
        }
    }
    triple.heard.clear();
    triple.run(100ms, true);
    for (std::size_t peer = 0; peer < 3; ++peer) {
        for (std::size_t line = 0; line < 2; ++line) {
            EXPECT_GE((triple.heard[{peer, line}]), 98) << peer << ' ' << line;
            EXPECT_EQ(triple.peers.at(peer)[line].sealed()->misnamed(), 0U);
            EXPECT_EQ(triple.peers.at(peer)[line].sealed()->counts().unknown_key, 0U);
        }
    }
}

TEST(Lines, GoOnWithOneOfTheirKeysInATick)
{
    // A side that hears nothing begins one handshake with each other peer, and each takes several
    // multiplications. Handled at once, both beginnings would leave in the same tick.
    Lines lone = keyed_lines(1, 10);
    std::vector<std::vector<std::size_t>> began;
    for (base::TimePoint now{1000s}; now < base::TimePoint{1000s} + 50ms; now += 1ms) {
        lone.tick({now, now.time_since_epoch().count()});
        std::vector<std::size_t>& tick = began.emplace_back();
        for (const std::size_t line : {0U, 1U}) {
            lone[line].send_all(
                [] { return std::optional<wire::Datagram>{}; },
                [&](std::span<const std::byte>, const secure::Place&) { tick.push_back(line); },
                now);
        }
    }
    std::array<int, 2> of_line{};
    for (const auto& tick : began) {
        EXPECT_LE(tick.size(), 1U);
        for (const std::size_t line : tick) ++of_line.at(line);
    }
    EXPECT_GE(of_line[0], 1);
    EXPECT_GE(of_line[1], 1);
}

} // namespace hapnet::peer::line
