// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/captures.hpp"

#include "emulator/core/pipeline.hpp"
#include "emulator/tools/learn/learn.hpp"
#include "emulator/tools/probe_message.hpp"
#include "tests/unit/emulator/tools/learn/packets.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

namespace hapnet::emulator::tools {
namespace {

using namespace std::chrono_literals;
using namespace test;           // NOLINT(google-build-using-namespace): packets
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only

constexpr base::Duration begin = 1'700'000'000s;

/// Two captures, and their contents.
struct BothEnds {
    PcapFile a;
    PcapFile b;
    MeasuredWay up;
    MeasuredWay down;
};

/// The captures of two hosts that send to each other every 20 ms through a relay with an address of
/// its own. The clock of b is ahead by `fast`.
BothEnds captured(const Conditions& up, const Conditions& down, std::uint64_t count,
                  base::Duration fast = {})
{
    BothEnds ends;
    Pipeline there{up, base::Seed{42}, Direction::up};
    Pipeline back{down, base::Seed{42}, Direction::down};
    const Ipv4Ends behind{0x0a00'0063, 0x0a00'0002};
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto at = begin + 20ms * static_cast<base::Duration::rep>(i);
        const auto question = numbered_payload(i);
        const Fate of_up = there.on_packet({i, 24, at - begin});
        ends.a.add(at, udp_packet(question, 7000, 7001));
        ends.up.add(of_up.delay, of_up.drop.has_value());
        if (!of_up.drop) ends.b.add(at + of_up.delay + fast, udp_packet(question, 5, 6, behind));
        const auto answer = numbered_payload(1'000'000 + i);
        const Fate of_down = back.on_packet({i, 24, at - begin});
        ends.b.add(at + fast, udp_packet(answer, 6, 5, behind.back()));
        ends.down.add(of_down.delay, of_down.drop.has_value());
        if (!of_down.drop) {
            ends.a.add(at + of_down.delay, udp_packet(answer, 7001, 7000, Ipv4Ends{}.back()));
        }
    }
    return ends;
}

/// Removes losses before the first and after the last datagram that arrived.
MeasuredWay trimmed(const MeasuredWay& way)
{
    MeasuredWay inner;
    std::size_t first = 0;
    std::size_t behind = way.lost.size();
    while (way.lost[first]) ++first;
    while (way.lost[behind - 1]) --behind;
    for (std::size_t i = first; i < behind; ++i) inner.add(way.delays[i], way.lost[i]);
    return inner;
}

base::Result<Measurement> measured(const PcapFile& a, const PcapFile& b)
{
    const std::array files{MeasuredFile{"a.pcap", a.bytes()}, MeasuredFile{"b.pcap", b.bytes()}};
    return read_measurements(files);
}

bool says(const Measurement& measurement, std::string_view words)
{
    for (const std::string& remark : measurement.remarks) {
        if (remark.find(words) != std::string::npos) return true;
    }
    return false;
}

Conditions bursts()
{
    Conditions way;
    way.loss = {GilbertElliott{1_percent, 5_percent, 1_percent, 60_percent}};
    way.delay = constant(40ms);
    way.jitter = {NormalLaw{{}, 3ms}};
    return way;
}

TEST(Captures, OfBothEndsTellEveryDelayAndEveryLossOfEachWay)
{
    const auto ends =
        captured(bursts(), {.loss = {RandomLoss{5_percent}}, .delay = constant(15ms)}, 20'000);
    const auto found = measured(ends.a, ends.b);
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_TRUE(found->up && found->down);
    EXPECT_EQ(found->up->delays, trimmed(ends.up).delays);
    EXPECT_EQ(found->up->lost, trimmed(ends.up).lost);
    EXPECT_EQ(found->down->delays, trimmed(ends.down).delays);
    EXPECT_EQ(found->down->lost, trimmed(ends.down).lost);
    EXPECT_EQ(found->up->spacing, 20ms);
    EXPECT_TRUE(says(*found, "The clocks of the two ends are taken for one"));
    EXPECT_TRUE(says(*found, "UDP 10.0.0.1:7000 > 10.0.0.2:7001"));
    // In the other order, up and down are swapped.
    EXPECT_EQ(measured(ends.b, ends.a)->down->delays, found->up->delays);
}

TEST(Captures, GiveBackTheProfileThatMadeThem)
{
    const auto ends = captured(bursts(), {.delay = constant(15ms)}, 100'000);
    const auto found = measured(ends.a, ends.b);
    ASSERT_TRUE(found) << found.error().message;
    const auto lesson = learn(*found);
    ASSERT_TRUE(lesson);
    const auto& [up, down] = lesson->profile.path;
    EXPECT_EQ(std::get<ConstantLaw>(down.delay.law).value, 15ms);
    EXPECT_TRUE(down.loss.empty());
    const auto& jitter = std::get<NormalLaw>(up.jitter.law);
    // Some 92 000 arrive: sd / sqrt(2 n) = 7 us; of the mean 10 us.
    EXPECT_NEAR(base::to_seconds(jitter.sd), 0.003, 4 * 7e-6);
    EXPECT_NEAR(base::to_seconds(std::get<ConstantLaw>(up.delay.law).value), 0.040, 4 * 10e-6);
    ASSERT_EQ(up.loss.size(), 1U);
    const auto* law = std::get_if<GilbertElliott>(&up.loss.front());
    ASSERT_NE(law, nullptr);
    EXPECT_NEAR(law->good_to_bad.fraction(), 0.01, 0.002);
    EXPECT_NEAR(law->bad_to_good.fraction(), 0.05, 0.008);
    EXPECT_NEAR(law->loss_bad.fraction(), 0.60, 0.03);
}

TEST(Captures, OfTwoClocksGetTheSameLeastDelayBothWays)
{
    const Conditions up{.delay = constant(40ms), .jitter = {UniformLaw{{}, 5ms}}};
    for (const base::Duration fast : {-3000ms, -100ms, 100ms, 7000ms}) {
        const auto ends = captured(up, {.delay = constant(15ms)}, 1000, fast);
        const auto found = measured(ends.a, ends.b);
        ASSERT_TRUE(found && found->up && found->down) << base::to_seconds(fast);
        EXPECT_TRUE(says(*found, "The ends have two clocks"));
        const auto least = *std::min_element(ends.up.delays.begin(), ends.up.delays.end());
        const auto half = (*least + 15ms) / 2;
        EXPECT_NEAR(base::to_seconds(*found->down->delays[0]), base::to_seconds(half), 1e-8);
        EXPECT_NEAR(base::to_seconds(*found->up->delays[7] + *found->down->delays[7]),
                    base::to_seconds(*ends.up.delays[7] + 15ms), 1e-8);
    }
}

TEST(Captures, OfOneWayAloneSayWhichOne)
{
    PcapFile a;
    PcapFile b;
    for (std::uint64_t i = 0; i < 100; ++i) {
        const auto at = begin + 10ms * static_cast<base::Duration::rep>(i);
        a.add(at, udp_packet(numbered_payload(i)));
        b.add(at + 30ms, udp_packet(numbered_payload(i)));
    }
    const auto there = measured(a, b);
    ASSERT_TRUE(there && there->up);
    EXPECT_FALSE(there->down);
    const auto lesson = learn(*there);
    ASSERT_TRUE(lesson);
    EXPECT_EQ(std::get<ConstantLaw>(lesson->profile.path.up.delay.law).value, 30ms);
    EXPECT_EQ(lesson->profile.path.down, Conditions{});
    EXPECT_NE(to_text(*lesson).find("Nothing was measured down"), std::string::npos);
    EXPECT_TRUE(measured(b, a)->down);
}

TEST(Captures, CountCopiesAndOvertakingAndLeaveOutWhatLooksAlike)
{
    PcapFile a;
    PcapFile b;
    for (std::uint64_t i = 0; i < 10; ++i) {
        const auto at = begin + 10ms * static_cast<base::Duration::rep>(i);
        a.add(at, udp_packet(numbered_payload(i == 5 || i == 6 ? 99 : i)));
        b.add(at + (i == 2 ? 35ms : 10ms), udp_packet(numbered_payload(i == 5 ? 99 : i)));
    }
    b.add(begin + 200ms, udp_packet(numbered_payload(3)));
    const auto found = measured(a, b);
    ASSERT_TRUE(found && found->up);
    EXPECT_EQ(found->up->delays.size(), 8U);
    EXPECT_EQ(found->up->delays[3], 10ms); // the first of the copies
    EXPECT_EQ(found->up->reordered, 1U);   // two have overtaken it
    EXPECT_TRUE(says(*found, "2 datagrams are left out"));
    EXPECT_TRUE(says(*found, "1 datagrams arrived more than once"));
}

TEST(Captures, MatchCutPacketsByWhatBothHaveOfThem)
{
    PcapFile a;
    PcapFile b;
    for (std::uint64_t i = 0; i < 10; ++i) {
        const auto at = begin + 10ms * static_cast<base::Duration::rep>(i);
        a.add(at, udp_packet(numbered_payload(i)), 28 + 18);
        b.add(at + 5ms, udp_packet(numbered_payload(i)));
    }
    const auto found = measured(a, b);
    ASSERT_TRUE(found && found->up) << found.error().message;
    EXPECT_EQ(found->up->delays.size(), 10U);
}

TEST(Captures, OfOneEndTellTheRoundTripsOfPing)
{
    PcapFile file;
    for (std::uint16_t i = 1; i <= 50; ++i) {
        const auto at = begin + 100ms * i;
        file.add(at, echo_packet(false, i, "payload"));
        if (i % 10 != 0) file.add(at + 30ms + i * 1ms, echo_packet(true, i, "payload"));
    }
    const std::array files{MeasuredFile{"ping.pcap", file.bytes()}};
    const auto found = read_measurements(files);
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_TRUE(found->round_trip);
    EXPECT_EQ(found->round_trip->delays.size(), 49U); // the last has no answer behind it
    EXPECT_EQ(found->round_trip->delays[0], 31ms);
    EXPECT_TRUE(found->round_trip->lost[9]);
    EXPECT_EQ(std::count(found->round_trip->lost.begin(), found->round_trip->lost.end(), true), 4);
    EXPECT_EQ(found->round_trip->spacing, 100ms);
    EXPECT_TRUE(says(*found, "ping 10.0.0.1 > 10.0.0.2: 45 datagrams have an answer"));
}

TEST(Captures, SayThatOneIsCutOffAndWhere)
{
    PcapFile file;
    for (std::uint16_t i = 1; i <= 8; ++i) {
        file.add(begin + 100ms * i, echo_packet(false, i, "payload"));
        file.add(begin + 100ms * i + 30ms, echo_packet(true, i, "payload"));
    }
    const std::array whole{MeasuredFile{"a.pcap", file.bytes()}};
    EXPECT_FALSE(says(*read_measurements(whole), "is cut off"));
    const std::array cut{MeasuredFile{"a.pcap", file.bytes().substr(0, file.bytes().size() - 1)}};
    const auto found = read_measurements(cut);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->round_trip->delays.size(), 7U);
    EXPECT_TRUE(says(*found, "a.pcap is cut off within packet 16: only what comes before is "
                             "learned"));
    const std::array packed{MeasuredFile{"a.pcap.gz", "\x1f\x8b\x08"}};
    EXPECT_EQ(read_measurements(packed).error().message,
              "a.pcap.gz: the file is compressed (gzip): unpack it first, for example with gunzip "
              "-k");
}

TEST(Captures, KnowTheAnswersOfProbeAndOfWhatComesBackUnchanged)
{
    for (const bool is_probe : {true, false}) {
        PcapFile file;
        for (std::uint64_t i = 0; i < 20; ++i) {
            const auto at = begin + 10ms * static_cast<base::Duration::rep>(i);
            ProbeMessage message{.session = 5, .sequence = i};
            const auto payload_of = [&] {
                std::string bytes(ProbeMessage::bytes_min, '\0');
                encode(message, std::as_writable_bytes(std::span{bytes}));
                return is_probe ? bytes : numbered_payload(i);
            };
            file.add(at, udp_packet(payload_of()));
            message.is_answer = true;
            message.heard = i + 1;
            file.add(at + 4ms, udp_packet(payload_of(), 7001, 7000, Ipv4Ends{}.back()));
        }
        const auto capture = read_capture(file.bytes());
        ASSERT_TRUE(capture);
        const auto found = measure_capture(*capture);
        ASSERT_TRUE(found) << is_probe;
        EXPECT_EQ(found->round_trip->delays, std::vector<std::optional<base::Duration>>(20, 4ms));
        EXPECT_TRUE(says(*found, "UDP 10.0.0.1:7000 > 10.0.0.2:7001: 20 datagrams"));
    }
}

TEST(Captures, NameTheFilesThatTellNothing)
{
    PcapFile a;
    PcapFile b;
    a.add(begin, udp_packet("one"));
    b.add(begin, udp_packet("two"));
    const auto apart = measured(a, b);
    ASSERT_FALSE(apart);
    EXPECT_EQ(apart.error().message.rfind("a.pcap and b.pcap: the two captures share no", 0), 0U);
    const std::array one{MeasuredFile{"a.pcap", a.bytes()}};
    EXPECT_EQ(read_measurements(one).error().message.rfind("a.pcap: no datagram has an answer", 0),
              0U);
    const std::array three{one[0], one[0], MeasuredFile{"c.pcap", b.bytes()}};
    EXPECT_EQ(read_measurements(three).error().message,
              "c.pcap: a third capture: give one, or those of both ends");
}

} // namespace
} // namespace hapnet::emulator::tools
