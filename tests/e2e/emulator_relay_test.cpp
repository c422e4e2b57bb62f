// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Effects of the emulator on datagrams on real sockets, in real time.
#include "proto/base/random.hpp"
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/udp.hpp"
#include "tests/support/ipv6.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <span>
#include <string>
#include <sys/socket.h>
#include <tuple>
#include <unistd.h>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

base::Duration median_delay(std::vector<Arrival> arrivals)
{
    if (arrivals.empty()) return base::Duration::max();
    const auto middle = arrivals.begin() + static_cast<std::ptrdiff_t>(arrivals.size() / 2);
    std::nth_element(arrivals.begin(), middle, arrivals.end(),
                     [](const Arrival& x, const Arrival& y) { return x.delay < y.delay; });
    return middle->delay;
}

/// Returns the options that name both hosts.
std::vector<std::string> naming(const Host& a, const Host& b, std::vector<std::string> options)
{
    options.insert(options.end(), {"--a", a.endpoint().to_text(), "--b", b.endpoint().to_text()});
    return options;
}

/// Returns those of the numbers 0 to count-1 that get from A to B.
std::vector<std::uint64_t> survivors(const std::vector<std::string>& options, std::uint64_t count)
{
    Host a;
    Host b;
    Emulator emulator{naming(a, b, options)};
    stream(a, emulator.a(), count, 200us);
    auto numbers = numbers_of(b.receive(count, 500ms));
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["up"]["received"], count);
    EXPECT_EQ(statistics["up"]["delivered"], numbers.size());
    return numbers;
}

int times_in(const std::string& text, std::string_view words)
{
    int times = 0;
    for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) {
        ++times;
    }
    return times;
}

/// Sends a datagram that names `from` as its sender. Returns false where that is not allowed.
bool send_forged(const net::Endpoint& from, const net::Endpoint& to)
{
    const int raw = socket(AF_INET, SOCK_RAW | SOCK_CLOEXEC, IPPROTO_UDP);
    if (raw < 0) return false;
    const std::array<std::uint16_t, 5> datagram{htons(from.port()), htons(to.port()),
                                                htons(sizeof datagram), 0, 0};
    const auto sent = sendto(raw, datagram.data(), sizeof datagram, 0, to.address(), to.length());
    close(raw);
    return sent == static_cast<ssize_t>(sizeof datagram);
}

} // namespace

TEST(Emulator, ForwardsBothWaysAndDelaysEachByItsOwnDelay)
{
    Host a;
    Host b;
    Emulator emulator{naming(a, b, {"--delay", "160ms", "--down.delay", "40ms"})};
    stream(a, emulator.a(), 1000, 1ms);
    EXPECT_EQ(b.receive(1000, 1s).size(), 1000U);
    stream(b, emulator.b(), 500, 1ms);
    EXPECT_EQ(a.receive(500, 1s).size(), 500U);

    EXPECT_NEAR(base::to_seconds(median_delay(b.arrivals())), 0.160, 0.001);
    EXPECT_NEAR(base::to_seconds(median_delay(a.arrivals())), 0.040, 0.001);
    const auto numbers = numbers_of(b.arrivals());
    EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
    // Never early, but for two kernel stamps converted to the monotonic clock, each to 1 us.
    for (const Arrival& arrival : b.arrivals()) EXPECT_GE(arrival.delay, 160ms - 2us);

    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["up"]["received"], 1000);
    EXPECT_EQ(statistics["up"]["delivered"], 1000);
    EXPECT_EQ(statistics["up"]["bytes_in"], 100'000);
    EXPECT_EQ(statistics["up"]["bytes_out"], 100'000);
    EXPECT_EQ(statistics["up"]["reordered"], 0);
    EXPECT_EQ(statistics["down"]["delivered"], 500);
    EXPECT_EQ(statistics["configuration_at_start"]["down"]["delay"], "40ms");
    EXPECT_TRUE(statistics["up"]["lateness_us"]["p99"].is_number());
}

TEST(Emulator, WithZeroDelayForwardsAtOnce)
{
    for (const std::string timing : {"eco", "precise", "spin"}) {
        Host a;
        Host b;
        Emulator emulator{naming(a, b, {"--delay", "0", "--timing", timing})};
        stream(a, emulator.a(), 300, 1ms);
        EXPECT_EQ(b.receive(300, 1s).size(), 300U) << timing;
        EXPECT_LT(median_delay(b.arrivals()), 1ms) << timing;
        EXPECT_EQ(emulator.stop()["timing"], timing);
    }
}

TEST(Emulator, LosesTheSameDatagramsForTheSameSeedWhateverTheDelay)
{
    const auto first = survivors({"--loss", "50%", "--seed", "42"}, 2000);
    const auto again = survivors({"--loss", "50%", "--seed", "42", "--delay", "20ms"}, 2000);
    const auto other = survivors({"--loss", "50%", "--seed", "43"}, 2000);
    EXPECT_EQ(first, again);
    EXPECT_NE(first, other);
    // Binomial(2000, 1/2): standard deviation 22.4.
    EXPECT_NEAR(static_cast<double>(first.size()), 1000.0, 4 * 22.4);
}

TEST(Emulator, LosesExactlyTheBurstsItIsAskedFor)
{
    EXPECT_EQ(survivors({"--burst-loss", "40/100"}, 1000).size(), 600U);
}

TEST(Emulator, KeepsOrderUnderJitterUnlessItIsSetFree)
{
    const auto kept = survivors({"--delay", "20ms", "--jitter", "10ms"}, 500);
    EXPECT_EQ(kept.size(), 500U);
    EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
    const auto freed = survivors({"--delay", "20ms", "--jitter", "10ms", "--order", "free"}, 500);
    EXPECT_EQ(freed.size(), 500U);
    EXPECT_FALSE(std::is_sorted(freed.begin(), freed.end()));
}

TEST(Emulator, AdoptsTheFirstSenderOfEachSideOnLoopback)
{
    Host a;
    Host b;
    Emulator emulator{{}};
    a.send(emulator.a(), 0);
    const auto only_a = "A is " + a.endpoint().to_text() + ", B is not known yet";
    ASSERT_TRUE(emulator.process().wait_for_err(only_a, 5s));
    b.send(emulator.b(), 1);
    EXPECT_EQ(a.receive(1, 1s).size(), 1U);
    a.send(emulator.a(), 2);
    EXPECT_EQ(numbers_of(b.receive(1, 1s)), (std::vector<std::uint64_t>{2}));
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["up"]["dropped"]["no_destination"], 1);
    EXPECT_EQ(statistics["a"], a.endpoint().to_text());
}

TEST(Emulator, AdoptsAnewWhenTheAdoptedOneHasBeenSilentForASecond)
{
    Host b;
    Host restarted;
    Emulator emulator{{"--b", b.endpoint().to_text()}};
    {
        Host a;
        a.send(emulator.a(), 0);
        EXPECT_EQ(b.receive(1, 1s).size(), 1U);
    }
    restarted.send(emulator.a(), 1);
    ASSERT_TRUE(emulator.process().wait_for_err(
        "another sender is taken when it has been silent for 1 s", 5s));
    EXPECT_EQ(b.receive(2, 300ms).size(), 1U);
    EXPECT_FALSE(emulator.process().wait_exit(900ms)); // goes on running, for more than a second
    restarted.send(emulator.a(), 2);
    EXPECT_EQ(numbers_of(b.receive(2, 1s)), (std::vector<std::uint64_t>{0, 2}));
    b.send(emulator.b(), 3);
    EXPECT_EQ(numbers_of(restarted.receive(1, 1s)), (std::vector<std::uint64_t>{3}));
    EXPECT_EQ(emulator.stop()["up"]["strangers"], 1);
}

TEST(Emulator, CountsAndDropsStrangers)
{
    Host a;
    Host b;
    Host stranger;
    Emulator emulator{naming(a, b, {})};
    for (std::uint64_t i = 0; i < 5; ++i) stranger.send(emulator.a(), i);
    for (std::uint64_t i = 0; i < 3; ++i) stranger.send(emulator.b(), i);
    a.send(emulator.b(), 8); // known, but not on this side
    a.send(emulator.a(), 9);
    EXPECT_EQ(numbers_of(b.receive(1, 1s)), (std::vector<std::uint64_t>{9}));
    const auto said = stranger.endpoint().to_text() + " sends to --listen-a " +
                      emulator.a().to_text() + ": dropped, as only " + a.endpoint().to_text();
    ASSERT_TRUE(emulator.process().wait_for_err(said, 5s));
    EXPECT_EQ(times_in(emulator.process().err(), "--listen-a"), 1); // not for each datagram
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["up"]["strangers"], 5);
    EXPECT_EQ(statistics["down"]["strangers"], 4);
    EXPECT_EQ(statistics["up"]["received"], 1);
    EXPECT_EQ(statistics["down"]["received"], 0);
    EXPECT_TRUE(statistics["down"]["lateness_us"]["p99"].is_null());
}

TEST(Emulator, TakesNothingThatIsForgedToComeFromItself)
{
    Emulator emulator{{"--duplicate", "100%"}};
    if (!send_forged(emulator.b(), emulator.a())) GTEST_SKIP() << "no raw sockets here";
    ASSERT_TRUE(send_forged(emulator.a(), emulator.b()));
    ASSERT_TRUE(send_forged(emulator.b(), emulator.a()));
    Host a;
    a.send(emulator.a(), 0); // after the others: once it is known they have been judged
    ASSERT_TRUE(emulator.process().wait_for_err("A is " + a.endpoint().to_text(), 5s));
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["up"]["strangers"], 2);
    EXPECT_EQ(statistics["up"]["received"], 1);
    EXPECT_EQ(statistics["down"]["strangers"], 1);
    EXPECT_EQ(statistics["down"]["received"], 0);
}

TEST(Emulator, RelaysOverIpv6)
{
    if (!test::has_ipv6()) GTEST_SKIP() << "no IPv6 here";
    Host a{"[::1]:0"};
    Host b{"[::1]:0"};
    Emulator emulator{{"--delay", "5ms"}, "[::1]:0"};
    b.send(emulator.b(), 0);
    ASSERT_TRUE(emulator.process().wait_for_err("B is " + b.endpoint().to_text(), 5s));
    stream(a, emulator.a(), 100, 1ms);
    EXPECT_EQ(b.receive(100, 1s).size(), 100U);
    EXPECT_EQ(emulator.stop()["b"], b.endpoint().to_text());
}

TEST(Emulator, IsNotValidWhenItHasNoRoomForWhatIsInFlight)
{
    Host a;
    Host b;
    Emulator emulator{naming(a, b, {"--delay", "10min", "--in-flight", "1MiB"})};
    const std::vector<std::byte> bytes(1200);
    constexpr int room = 16 * 42; // blocks, and datagrams of this size in each
    for (int i = 0; i < room + 8; ++i) {
        a.send_bytes(emulator.a(), bytes);
        if (i % 50 == 0) std::ignore = a.receive(1, 5ms); // it keeps up
    }
    std::ignore = a.receive(1, 100ms);
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["up"]["in_flight"], room);
    EXPECT_EQ(statistics["up"]["dropped"]["queue_full"], 8);
    EXPECT_EQ(statistics["up"]["invalid_because"][0], "the emulator lost 8 as queue_full");
    EXPECT_EQ(statistics["invalid_because"][0], "up: the emulator lost 8 as queue_full");
    EXPECT_EQ(statistics["invalid_because"].size(), 1U);
    EXPECT_EQ(statistics["up"]["valid"], false);
    EXPECT_EQ(statistics["down"]["valid"], true);
    EXPECT_EQ(statistics["valid"], false);
}

TEST(Emulator, SaysOfAFewLateDatagramsWhatItsStatisticsSay)
{
    Host a;
    Host b;
    Emulator emulator{naming(a, b, {"--delay", "1ms", "--budget", "1ns"})};
    a.send(emulator.a(), 0);
    ASSERT_EQ(b.receive(1, 5s).size(), 1U);
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["up"]["valid"], false);
    EXPECT_EQ(statistics["down"]["valid"], true);
    const std::string& summary = emulator.process().err();
    EXPECT_EQ(times_in(summary, "NOT VALID"), 1) << summary;
    EXPECT_NE(summary.find("p99 of so few datagrams is the latest of them"), std::string::npos)
        << summary;
    EXPECT_EQ(summary.find("too few datagrams"), std::string::npos) << summary;
}

TEST(Emulator, SurvivesRandomBytesOfAllSizesOnBothSockets)
{
    Host a;
    Host b;
    Host stranger;
    Emulator emulator{naming(a, b, {"--delay", "1ms", "--loss", "10%"})};
    const auto chance = base::Seed{1}.stream("random bytes");
    std::vector<std::byte> bytes(65'507); // the largest UDP payload over IPv4
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] = static_cast<std::byte>(chance.below(256, i));
    }
    for (std::uint64_t i = 0; i < 600; ++i) {
        const auto size = static_cast<std::size_t>(chance.below(i % 50 == 0 ? 65'508 : 1500, i, 1));
        const auto datagram = std::span{bytes}.first(size);
        for (Host* host : {&a, &b, &stranger}) {
            host->send_bytes(i % 2 == 0 ? emulator.a() : emulator.b(), datagram);
        }
        if (i % 20 == 0) std::ignore = b.receive(1, 1ms);
    }
    a.send_bytes(emulator.a(), bytes);
    stream(a, emulator.a(), 100, 1ms);
    EXPECT_GT(b.receive(100, 500ms).size(), 60U);
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["up"]["received"].get<int>() + statistics["up"]["overflowed"].get<int>() +
                  statistics["up"]["strangers"].get<int>(),
              300 * 3 + 1 + 100);
}

TEST(Emulator, IsThereAgainOnTheSamePortsAfterAKill)
{
    Host a;
    Host b;
    Emulator first{naming(a, b, {})};
    const auto at_a = first.a();
    const auto at_b = first.b();
    first.process().signal(SIGKILL);
    EXPECT_EQ(first.process().wait_exit(5s), 128 + SIGKILL);
    Process second{"hapnet-emulator",
                   naming(a, b, {"--listen-a", at_a.to_text(), "--listen-b", at_b.to_text()})};
    ASSERT_TRUE(second.wait_for_out("ready ", 5s));
    a.send(at_a, 7);
    EXPECT_EQ(numbers_of(b.receive(1, 1s)), (std::vector<std::uint64_t>{7}));
}

} // namespace hapnet::e2e
