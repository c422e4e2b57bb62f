// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/line/line.hpp"

#include "peer/line/status.hpp"
#include "proto/secure/key_file.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::peer::line {

namespace {

using namespace std::chrono_literals;

using Bytes = std::vector<std::byte>;

secure::Secret secret_of(std::uint8_t number)
{
    secure::Secret secret;
    std::ranges::fill(secret.bytes(), std::byte{number});
    return secret;
}

secure::Place place_of(std::uint8_t number)
{
    secure::Place place{};
    place[0] = std::byte{number};
    return place;
}

struct Keyed {
    std::uint8_t id = 1;
    std::uint8_t circle = 7; // names its keys
    std::uint32_t run = 11;
};

Line keyed_line(const Keyed& setting)
{
    secure::prepare();
    secure::Entropy entropy{secret_of(setting.circle)};
    const auto files = secure::make_circle("test", 2, entropy);
    const secure::KeyFile& own = files.at(setting.id - 1U);
    secure::Association::Config config;
    config.own_id = setting.id;
    config.other_id = static_cast<std::uint8_t>(3 - setting.id);
    config.circle = own.circle();
    config.run = setting.run;
    config.place = place_of(config.other_id);
    return Line{std::make_unique<Sealed>(config, own.keys_with(own.others.front()),
                                         secret_of(static_cast<std::uint8_t>(setting.run)))};
}

Bytes bytes_of(std::span<const std::byte> bytes) { return {bytes.begin(), bytes.end()}; }

wire::Datagram hello_of(std::uint16_t id, std::uint32_t run)
{
    wire::Hello hello;
    hello.nonce = run;
    hello.peer_id = id;
    hello.tick_rate_hz = 1000;
    hello.task = wire::TaskName::from_text("P1").value();
    return wire::encode(hello);
}

/// Two lines, 5 ms apart, with each side's messages to send in a tick, and those received.
class LinePair {
public:
    LinePair(Line a, Line b) : lines_{std::move(a), std::move(b)} {}

    Line& line(std::size_t side) { return lines_.at(side); }
    base::TimePoint now() const { return now_; }
    const std::vector<Bytes>& heard(std::size_t side) const { return heard_.at(side); }
    const std::vector<News>& news(std::size_t side) const { return news_.at(side); }
    const std::vector<Bytes>& sent(std::size_t side) const { return sent_.at(side); }

    void say(std::size_t side, const wire::Datagram& message) { waiting_.at(side) = {message}; }

    void run(base::Duration time)
    {
        for (const auto end = now_ + time; now_ < end; now_ += 1ms) {
            for (const std::size_t side : {0U, 1U}) step(side);
        }
    }
    /// Gives a datagram to a side, as if it came from `place`.
    bool give(std::size_t to, const Bytes& datagram, const secure::Place& from)
    {
        const auto message = lines_.at(to).open(datagram, from, now_);
        if (message) heard_.at(to).push_back(bytes_of(*message));
        return message.has_value();
    }

private:
    struct OnTheWay {
        Bytes bytes;
        base::TimePoint due;
    };

    void step(std::size_t side)
    {
        auto& inbox = on_the_way_.at(side);
        while (!inbox.empty() && inbox.front().due <= now_) {
            give(side, inbox.front().bytes, place_of(static_cast<std::uint8_t>(2 - side)));
            inbox.erase(inbox.begin());
        }
        Line& line = lines_.at(side);
        line.tick({now_, now_.time_since_epoch().count()});
        auto& waiting = waiting_.at(side);
        line.send_all([&] { return std::exchange(waiting, std::nullopt); },
                      [&](std::span<const std::byte> bytes, const secure::Place&) {
                          sent_.at(side).push_back(bytes_of(bytes));
                          on_the_way_.at(1 - side).push_back({bytes_of(bytes), now_ + 5ms});
                      },
                      now_);
        while (const auto news = line.news()) news_.at(side).push_back(*news);
    }

    base::TimePoint now_{1000s};
    std::array<Line, 2> lines_;
    std::array<std::optional<wire::Datagram>, 2> waiting_;
    std::array<std::vector<OnTheWay>, 2> on_the_way_;
    std::array<std::vector<Bytes>, 2> heard_, sent_;
    std::array<std::vector<News>, 2> news_;
};

} // namespace

TEST(Line, WithoutAKeyPassesWhatComesFromTheOtherSideAndCountsTheRest)
{
    Line line{place_of(2)};
    const Bytes any(86, std::byte{3});
    const auto message = line.open(any, place_of(2), {});
    ASSERT_TRUE(message);
    EXPECT_EQ(message->data(), any.data());
    EXPECT_FALSE(line.open(any, place_of(3), {}));
    EXPECT_EQ(line.strangers(), 1U);
    EXPECT_FALSE(line.is_sealed());
    EXPECT_EQ(line.sealed(), nullptr);
    EXPECT_FALSE(status_of(line, {}).key);
}

TEST(Line, WithAKeyCarriesAMessageUnchangedAndShowsNothingOfIt)
{
    LinePair pair{keyed_line({.id = 1, .run = 11}), keyed_line({.id = 2, .run = 22})};
    pair.run(100ms);
    EXPECT_EQ(pair.news(0), std::vector{News::sealed});
    EXPECT_EQ(pair.news(1), std::vector{News::sealed});
    const wire::Datagram hello = hello_of(1, 11);
    wire::State state;
    state.session = wire::session_number(11, 22);
    state.sequence = 1;
    state.hip = {{0.01, 0.02, 0.03}};
    const wire::Datagram plain = wire::encode(state);
    pair.say(0, hello);
    pair.run(1ms);
    pair.say(0, plain);
    pair.run(20ms);
    ASSERT_EQ(pair.heard(1).size(), 2U);
    EXPECT_EQ(pair.heard(1)[0], bytes_of(hello.bytes()));
    EXPECT_EQ(pair.heard(1)[1], bytes_of(plain.bytes()));
    const auto found = std::ranges::find(
        pair.sent(0), plain.bytes().size() + secure::state_overhead, &Bytes::size);
    ASSERT_NE(found, pair.sent(0).end());
    const Bytes& sealed = *found;
    const auto text = plain.bytes().subspan(secure::state_head_bytes, 16);
    EXPECT_EQ(std::search(sealed.begin(), sealed.end(), text.begin(), text.end()), sealed.end());
    EXPECT_EQ(status_of(pair.line(1), pair.now()).key->counts.handshakes, 1U);
    EXPECT_TRUE(status_of(pair.line(1), pair.now()).key->is_agreed);
}

TEST(Line, WithAKeyTellsOfEveryNextOne)
{
    LinePair pair{keyed_line({.id = 1, .run = 11}), keyed_line({.id = 2, .run = 22})};
    pair.run(100ms);
    for (int i = 0; i < 300; ++i) { // 5 min: two new keys
        pair.say(0, hello_of(1, 11));
        pair.say(1, hello_of(2, 22));
        pair.run(1s);
    }
    for (const std::size_t side : {0U, 1U}) {
        EXPECT_EQ(status_of(pair.line(side), pair.now()).key->counts.rekeys, 2U);
        EXPECT_EQ(std::ranges::count(pair.news(side), News::rekeyed), 2);
        EXPECT_EQ(std::ranges::count(pair.news(side), News::sealed), 1);
    }
}

TEST(Line, WithAKeyTakesNoHelloOfAnotherRunOrPeer)
{
    LinePair pair{keyed_line({.id = 1, .run = 11}), keyed_line({.id = 2, .run = 22})};
    pair.run(100ms);
    for (const auto& hello : {hello_of(1, 12), hello_of(3, 11)}) {
        pair.say(0, hello);
        pair.run(20ms);
    }
    EXPECT_TRUE(pair.heard(1).empty());
    EXPECT_EQ(status_of(pair.line(1), pair.now()).key->misnamed, 2U);
}

TEST(Line, WithAKeyTakesNothingPlainAndSaysSoAfterThreeHellos)
{
    LinePair pair{keyed_line({.id = 1}), Line{place_of(1)}};
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(pair.news(0).empty());
        pair.say(1, hello_of(2, 22));
        pair.run(20ms);
    }
    EXPECT_TRUE(pair.heard(0).empty());
    EXPECT_EQ(pair.news(0), std::vector{News::other_is_plain});
    EXPECT_EQ(pair.news(1), std::vector{News::other_is_sealed});
    EXPECT_EQ(status_of(pair.line(0), pair.now()).key->counts.unsealed, 3U);
}

TEST(Line, OfAnotherCircleIsNotHeardAndAPersonIsTold)
{
    LinePair pair{keyed_line({.id = 1, .circle = 7}),
                  keyed_line({.id = 2, .circle = 8, .run = 22})};
    pair.run(8s);
    for (const std::size_t side : {0U, 1U}) {
        EXPECT_EQ(pair.news(side), std::vector{News::other_circle});
        EXPECT_FALSE(status_of(pair.line(side), pair.now()).key->is_agreed);
    }
}

TEST(Line, TellsOfTwoProgramsThatPushEachOtherOut)
{
    LinePair pair{keyed_line({.id = 1}), keyed_line({.id = 2, .run = 22})};
    for (std::uint32_t run = 22; run < 26; ++run) {
        pair.line(1) = keyed_line({.id = 2, .run = run});
        pair.run(2s);
        pair.say(1, hello_of(2, run));
        pair.run(20ms);
    }
    EXPECT_EQ(std::ranges::count(pair.news(0), News::same_id), 1);
}

TEST(Line, IgnoresWhatIsLongerThanAnyMessage)
{
    LinePair pair{keyed_line({.id = 1}), keyed_line({.id = 2, .run = 22})};
    pair.run(100ms);
    EXPECT_FALSE(pair.give(1, Bytes(65'000, std::byte{0x4e}), place_of(1)));
}

} // namespace hapnet::peer::line
