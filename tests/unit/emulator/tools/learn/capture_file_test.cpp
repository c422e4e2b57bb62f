// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/capture_file.hpp"

#include "emulator/core/capture/pcapng.hpp"
#include "tests/unit/emulator/tools/learn/packets.hpp"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace hapnet::emulator::tools {
namespace {

using namespace std::chrono_literals;
using namespace test; // NOLINT(google-build-using-namespace): packets

/// The bytes of each of the first `fields` numbers of four bytes, the other way round.
std::string swapped(std::string bytes, std::size_t from, std::size_t fields)
{
    for (std::size_t i = 0; i < fields; ++i) {
        const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(from + 4 * i);
        std::reverse(at, at + 4);
    }
    return bytes;
}

std::string error_of(const std::string& bytes)
{
    const auto capture = read_capture(bytes);
    return capture ? "none" : capture.error().message;
}

TEST(CaptureFile, ReadsPcapOfEitherByteOrder)
{
    PcapFile file;
    file.add(5s + 7ns, udp_packet("hello"));
    auto other = swapped(swapped(file.bytes(), 0, 6), 24, 4);
    std::swap(other[4], other[6]); // the version is two numbers of two bytes
    std::swap(other[5], other[7]);
    for (const std::string& bytes : {file.bytes(), other}) {
        EXPECT_TRUE(is_capture(bytes));
        const auto capture = read_capture(bytes);
        ASSERT_TRUE(capture) << capture.error().message;
        ASSERT_EQ(capture->packets.size(), 1U);
        const SeenPacket& packet = capture->packets.front();
        EXPECT_EQ(packet.at, 5s + 7ns);
        EXPECT_EQ(packet.payload_bytes, 5U);
        EXPECT_EQ(to_text(packet.flow), "UDP 10.0.0.1:7000 > 10.0.0.2:7001");
        EXPECT_EQ(std::to_integer<char>(packet.payload[1]), 'e');
    }
}

TEST(CaptureFile, ReadsMicrosecondsToo)
{
    PcapFile file;
    file.add(5s + 7ns, udp_packet("hello")); // then 7 us
    auto bytes = file.bytes();
    bytes.replace(0, 4, "\xa1\xb2\xc3\xd4");
    EXPECT_EQ(read_capture(bytes)->packets.front().at, 5s + 7us);
}

TEST(CaptureFile, FindsThePacketBehindEachKindOfHeader)
{
    const std::string mac(12, 'm');
    const std::pair<std::uint32_t, std::string> links[] = {
        {1, mac + PacketBytes{}.u16(0x0800).text()},
        {1, mac + PacketBytes{}.u16(0x8100).u16(5).u16(0x0800).text()},
        {0, std::string(4, '\2')},
        {12, ""},
        {101, ""},
        {113, std::string(14, 'c') + PacketBytes{}.u16(0x0800).text()},
        {228, ""},
        {276, PacketBytes{}.u16(0x0800).text() + std::string(18, 'c')}};
    for (const auto& [link, header] : links) {
        PcapFile file{link};
        file.add(1s, header + udp_packet("12345"));
        const auto capture = read_capture(file.bytes());
        ASSERT_TRUE(capture) << link;
        ASSERT_EQ(capture->packets.size(), 1U) << link;
        EXPECT_EQ(capture->packets.front().payload_bytes, 5U) << link;
    }
}

TEST(CaptureFile, LeavesThePaddingOfAShortFrameOut)
{
    PcapFile file;
    file.add(1s, udp_packet("12345") + std::string(20, '\0'));
    EXPECT_EQ(read_capture(file.bytes())->packets.front().payload.size(), 5U);
}

TEST(CaptureFile, PassesOverWhatItCannotMatch)
{
    PcapFile file;
    file.add(1s, ipv4_packet(17, "fragment", {}, 0x2000));
    file.add(1s, ipv4_packet(47, "GRE"));
    file.add(1s, tcp_packet(9, "")); // an acknowledgement
    file.add(1s, "no IP");
    file.add(1s, tcp_packet(9, "data"));
    const auto capture = read_capture(file.bytes());
    ASSERT_TRUE(capture);
    EXPECT_EQ(capture->passed_over, 4U);
    ASSERT_EQ(capture->packets.size(), 1U);
    EXPECT_EQ(capture->packets.front().number, 9U);
    EXPECT_EQ(capture->packets.front().payload_bytes, 4U);
}

TEST(CaptureFile, KeepsOfACutPacketWhatItHadOnTheWire)
{
    PcapFile file;
    file.add(1s, udp_packet("1234567890"), 20 + 8 + 3);
    const auto capture = read_capture(file.bytes());
    ASSERT_EQ(capture->packets.size(), 1U);
    EXPECT_EQ(capture->packets.front().payload.size(), 3U);
    EXPECT_EQ(capture->packets.front().payload_bytes, 10U);
}

TEST(CaptureFile, ReadsThePcapngThatTheEmulatorWrites)
{
    std::string bytes;
    const std::array names{CaptureNames{}};
    append_capture_head(bytes, "a test", names);
    const std::string payload = "over six";
    UdpAddress six{.port = 9, .is_v6 = true};
    six.address[15] = std::byte{1};
    for (const auto side : {CaptureSide::a, CaptureSide::b}) {
        append_packet(bytes,
                      {.side = side,
                       .at = base::TimePoint{3ms},
                       .from = six,
                       .to = six,
                       .payload = std::as_bytes(std::span{payload})},
                      1'700'000'000s, "a comment");
    }
    const auto capture = read_capture(bytes);
    ASSERT_TRUE(capture) << capture.error().message;
    ASSERT_EQ(capture->packets.size(), 2U);
    EXPECT_EQ(capture->packets[0].interface, 0U);
    EXPECT_EQ(capture->packets[1].interface, 1U);
    EXPECT_EQ(capture->packets[1].at, 1'700'000'000s + 3ms);
    EXPECT_EQ(to_text(capture->packets[1].flow), "UDP [0:0:0:0:0:0:0:1]:9 > [0:0:0:0:0:0:0:1]:9");
}

/// A pcapng file with one interface and one packet, at this number of steps of its clock.
std::string pcapng(std::uint8_t resolution, std::uint64_t steps, std::uint64_t offset_s = 0)
{
    PacketBytes file;
    file.u32(0x0a0d'0d0a).u32(28).u32(0x1a2b'3c4d).u16(1).u16(0).u32(~0U).u32(~0U).u32(28);
    file.u32(1).u32(44).u16(101).u16(0).u32(0);
    file.u16(9).u16(1).u8(resolution).u8(0).u16(0);
    file.u16(14).u16(8).u32(offset_s >> 32).u32(offset_s).u16(0).u16(0).u32(44);
    const auto packet = udp_packet("1234"); // of 32 bytes
    file.u32(6).u32(64).u32(0).u32(steps >> 32).u32(steps).u32(32).u32(32).raw(packet).u32(64);
    return file.text();
}

TEST(CaptureFile, KnowsTheClocksOfPcapng)
{
    const auto at = [](const std::string& bytes) {
        const auto capture = read_capture(bytes);
        return capture ? capture->packets.at(0).at : base::Duration{-1};
    };
    EXPECT_EQ(at(pcapng(6, 2'000'003)), 2s + 3us);
    EXPECT_EQ(at(pcapng(9, 2'000'000'003)), 2s + 3ns);
    EXPECT_EQ(at(pcapng(12, 2'000'000'003'000)), 2s + 3ns);
    EXPECT_EQ(at(pcapng(0x80 | 10, 2 * 1024 + 512)), 2s + 500ms);
    EXPECT_EQ(at(pcapng(0x80 | 40, (std::uint64_t{5} << 39))), 2s + 500ms);
    EXPECT_EQ(at(pcapng(6, 1, 100)), 100s + 1us);
    EXPECT_EQ(error_of(pcapng(19, 1)), "packet 1: the steps of its clock are too small");
    EXPECT_EQ(error_of(pcapng(0, std::uint64_t{1} << 40)),
              "packet 1: its time is before 1970 or after 2096");
}

TEST(CaptureFile, EndsWhereALastPacketIsCutOff)
{
    PcapFile file;
    file.add(1s, udp_packet("first"));
    const auto whole = file.bytes().size();
    file.add(1s, udp_packet("second"));
    for (auto size = whole; size < file.bytes().size(); ++size) {
        const auto capture = read_capture(file.bytes().substr(0, size));
        EXPECT_EQ(capture->packets.size(), 1U);
        EXPECT_EQ(capture->cut_off_in, size == whole ? 0U : 2U);
    }
    EXPECT_EQ(read_capture(file.bytes())->cut_off_in, 0U);
    const auto next = pcapng(6, 1);
    EXPECT_EQ(read_capture(next)->cut_off_in, 0U);
    const auto cut = read_capture(next.substr(0, next.size() - 1));
    EXPECT_EQ(cut->packets.size(), 0U);
    EXPECT_EQ(cut->cut_off_in, 1U);
}

TEST(CaptureFile, RefusesNanosecondsWhereItsHeadSaysMicroseconds)
{
    const auto of = [](std::uint32_t fraction) {
        const auto head = PacketBytes{}.u32(0xa1b2'c3d4).text() + PcapFile{}.bytes().substr(4);
        return error_of(head + PacketBytes{}.u32(1).u32(fraction).u32(0).u32(0).text());
    };
    EXPECT_EQ(of(999'999), "none");
    EXPECT_EQ(of(1'000'000),
              "packet 1: its time is 1000000 of 1000000 parts of a second: the head of the file "
              "says microseconds, but its times are nanoseconds; write a1 b2 3c 4d over its first "
              "four bytes, or save it as pcapng");
    EXPECT_EQ(of(1'000'000'000),
              "packet 1: its time is 1000000000 of 1000000 parts of a second: damaged");
}

TEST(CaptureFile, NamesThePacketThatItCannotRead)
{
    EXPECT_FALSE(is_capture("PING x"));
    EXPECT_EQ(error_of("PING x"), "packet 1: the file is neither pcap nor pcapng");
    EXPECT_EQ(error_of("\xa1\xb2\xc3\xd4"), "packet 1: the head of the file is cut off");
    PcapFile wifi{127};
    EXPECT_EQ(error_of(wifi.bytes()),
              "packet 1: its interface has the link type 127; Ethernet, raw IP, Linux cooked and "
              "loopback can be read");
    PcapFile file;
    file.add(1s, udp_packet("first"));
    const auto damaged = PacketBytes{}.u32(1).u32(1).u32(~0U).u32(1).text();
    EXPECT_EQ(error_of(file.bytes() + damaged), "packet 2: it has 4294967295 bytes: damaged");
}

} // namespace
} // namespace hapnet::emulator::tools
