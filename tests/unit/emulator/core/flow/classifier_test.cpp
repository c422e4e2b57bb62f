// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/flow/classifier.hpp"

#include <array>
#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;
using Part = PacketFacts::Part;

constexpr base::TimePoint start{};

PacketFacts udp_packet(std::uint16_t from_port, std::uint16_t to_port)
{
    return {.protocol = 17,
            .version = 4,
            .has_ports = true,
            .from_port = from_port,
            .to_port = to_port,
            .bytes = 128,
            .from = {0, 0xffff'0a00'0001ULL},
            .to = {0, 0xffff'0a00'0002ULL}};
}

Classifier classifier_of(std::initializer_list<Match> matches)
{
    return Classifier{std::make_shared<const FlowFilters>(std::vector<Match>{matches})};
}

std::optional<std::size_t> only(const Match& match, const PacketFacts& facts)
{
    return classifier_of({match}).classify(facts, start);
}

TEST(Classifier, GivesAPacketToTheFirstFlowThatTakesIt)
{
    auto classifier = classifier_of({{.port = NumberRange{22, 22}}, {.protocol = 17}, {.ip = 4}});
    EXPECT_EQ(classifier.classify(udp_packet(4000, 22), start), 0U);
    EXPECT_EQ(classifier.classify(udp_packet(4000, 23), start), 1U);
    auto tcp = udp_packet(4000, 23);
    tcp.protocol = 6;
    EXPECT_EQ(classifier.classify(tcp, start), 2U);
    tcp.version = 6;
    EXPECT_EQ(classifier.classify(tcp, start), std::nullopt);
}

TEST(Classifier, KnowsTheEndsOfAPacketApart)
{
    const auto packet = udp_packet(4000, 5004);
    EXPECT_TRUE(only({.port = NumberRange{4000, 4000}}, packet));
    EXPECT_TRUE(only({.ports = NumberRange{5000, 5100}}, packet));
    EXPECT_TRUE(only({.to_port = NumberRange{5004, 5004}}, packet));
    EXPECT_FALSE(only({.from_port = NumberRange{5004, 5004}}, packet));
    const auto first = *Net::parse("10.0.0.1");
    const auto second = *Net::parse("10.0.0.2/31");
    EXPECT_TRUE(only({.host = first}, packet));
    EXPECT_TRUE(only({.net = second}, packet));
    EXPECT_TRUE(only({.to_net = second, .from_net = first}, packet));
    EXPECT_FALSE(only({.to_net = first}, packet));
    EXPECT_FALSE(only({.host = *Net::parse("10.0.0.3")}, packet));
}

TEST(Classifier, AsksForMarksSizesAndVersions)
{
    auto packet = udp_packet(1, 2);
    packet.dscp = 46;
    EXPECT_TRUE(only({.dscp = std::uint8_t{46}}, packet));
    EXPECT_FALSE(only({.dscp = std::uint8_t{0}}, packet));
    EXPECT_TRUE(only({.size = NumberRange{100, 128}}, packet));
    EXPECT_FALSE(only({.size = NumberRange{0, 127}}, packet));
    packet.bytes = 65'575; // the largest packet of IPv6
    EXPECT_TRUE(only({.size = NumberRange{1000, 65'535}}, packet));
    EXPECT_FALSE(only({.ip = std::uint8_t{6}}, packet));
}

TEST(Classifier, GivesArpOnlyToAFlowThatNamesIt)
{
    const PacketFacts arp{.protocol = PacketFacts::arp};
    EXPECT_TRUE(only({.protocol = PacketFacts::arp}, arp));
    EXPECT_FALSE(only({.size = NumberRange{0, 100}}, arp));
    EXPECT_FALSE(only({.dscp = std::uint8_t{0}}, arp));
}

TEST(Classifier, FindsNoPortsInAPacketWithoutAny)
{
    auto packet = udp_packet(0, 0);
    packet.has_ports = false;
    EXPECT_FALSE(only({.port = NumberRange{0, 65'535}}, packet));
    EXPECT_TRUE(only({.protocol = 17}, packet));
}

TEST(Classifier, TakesSixteenFlows)
{
    std::vector<Match> matches;
    for (std::uint16_t i = 0; i < flows_max; ++i) {
        matches.push_back({.port = NumberRange{i, i}, .host = *Net::parse("10.0.0.1")});
    }
    Classifier classifier{std::make_shared<const FlowFilters>(matches)};
    for (std::uint16_t i = 0; i < flows_max; ++i) {
        EXPECT_EQ(classifier.classify(udp_packet(i, 1000), start), i);
    }
    EXPECT_EQ(classifier.classify(udp_packet(16, 1000), start), std::nullopt);
}

TEST(Classifier, LetsLaterFragmentsFollowTheFirst)
{
    auto classifier = classifier_of({{.port = NumberRange{5004, 5004}}});
    auto first = udp_packet(4000, 5004);
    first.part = Part::first;
    first.fragment_id = 7;
    PacketFacts later = first;
    later.part = Part::later;
    later.has_ports = false;
    EXPECT_EQ(classifier.classify(later, start), std::nullopt); // it came before the first
    EXPECT_EQ(classifier.unknown_fragments(), 1U);
    EXPECT_EQ(classifier.classify(first, start), 0U);
    EXPECT_EQ(classifier.classify(later, start), 0U);
    later.fragment_id = 8; // of another packet
    EXPECT_EQ(classifier.classify(later, start), std::nullopt);
    EXPECT_EQ(classifier.unknown_fragments(), 2U);
}

TEST(Classifier, RemembersThatAFirstFragmentBelongsToNoFlow)
{
    auto classifier = classifier_of({{.port = NumberRange{5004, 5004}}, {.protocol = 17}});
    auto first = udp_packet(4000, 5004);
    first.part = Part::first;
    first.protocol = 132;
    EXPECT_EQ(classifier.classify(first, start), 0U);
    first.to_port = 9;
    EXPECT_EQ(classifier.classify(first, start), std::nullopt);
    auto later = first;
    later.part = Part::later;
    later.has_ports = false;
    EXPECT_EQ(classifier.classify(later, start), std::nullopt);
    EXPECT_EQ(classifier.unknown_fragments(), 0U);
}

TEST(Classifier, ForgetsAFirstFragmentAfterAMinute)
{
    auto classifier = classifier_of({{.port = NumberRange{5004, 5004}}});
    auto first = udp_packet(4000, 5004);
    first.part = Part::first;
    EXPECT_EQ(classifier.classify(first, start), 0U);
    first.part = Part::later;
    first.has_ports = false;
    EXPECT_EQ(classifier.classify(first, start + 60s), 0U);
    EXPECT_EQ(classifier.classify(first, start + 60s + 1ns), std::nullopt);
    EXPECT_EQ(classifier.unknown_fragments(), 1U);
}

TEST(Classifier, RemembersSoManyPacketsAtMost)
{
    auto classifier = classifier_of({{.port = NumberRange{5004, 5004}}});
    auto packet = udp_packet(4000, 5004);
    constexpr std::uint32_t flood = 100'000;
    for (std::uint32_t id = 0; id < flood; ++id) {
        packet.fragment_id = id;
        packet.part = Part::first;
        std::ignore = classifier.classify(packet, start);
    }
    packet.part = Part::later;
    packet.has_ports = false;
    std::size_t known = 0;
    for (std::uint32_t id = 0; id < flood; ++id) {
        packet.fragment_id = id;
        if (classifier.classify(packet, start)) ++known;
    }
    EXPECT_LE(known, Classifier::packets_max);
    EXPECT_GE(known, Classifier::packets_max / 2);
    EXPECT_EQ(classifier.unknown_fragments(), flood - known);
}

} // namespace
} // namespace hapnet::emulator
