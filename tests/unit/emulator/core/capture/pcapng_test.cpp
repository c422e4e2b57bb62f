// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/capture/pcapng.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>
#include <vector>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

UdpAddress v4(std::uint8_t last, std::uint16_t port)
{
    return {{std::byte{10}, std::byte{0}, std::byte{0}, std::byte{last}}, port, false};
}

UdpAddress v6(std::uint8_t last, std::uint16_t port)
{
    UdpAddress address{{std::byte{0xfd}}, port, true};
    address.address[15] = std::byte{last};
    return address;
}

UdpAddress mapped(std::uint8_t last, std::uint16_t port)
{
    UdpAddress address{{}, port, true};
    address.address[10] = address.address[11] = std::byte{0xff};
    address.address[12] = std::byte{10};
    address.address[15] = std::byte{last};
    return address;
}

std::string arrival_comment(const Fate& fate)
{
    std::string text;
    append_arrival_comment(text, fate);
    return text;
}

std::string departure_comment(base::Duration late, bool is_copy)
{
    std::string text;
    append_departure_comment(text, late, is_copy);
    return text;
}

TEST(Comments, SayWhatBecomesOfADatagram)
{
    EXPECT_EQ(arrival_comment({.drop = DropCause::gilbert_elliott}), "dropped: gilbert-elliott");
    EXPECT_EQ(arrival_comment({}), "delayed 0.0 ms");
    EXPECT_EQ(arrival_comment({.delay = 15us}), "delayed 15 us");
    EXPECT_EQ(arrival_comment({.delay = 999'500ns}), "delayed 1.0 ms");
    EXPECT_EQ(arrival_comment({.delay = 163'249us}), "delayed 163.2 ms");
    Fate fate{.delay = 163'250us, .copy_after = 0ns};
    fate.flips.count = 1;
    fate.displacement.places = 3;
    EXPECT_EQ(arrival_comment(fate), "delayed 163.3 ms, copied, 1 bit corrupted, displaced");
    fate.flips.count = 2;
    fate.displacement = {0, 1ms};
    EXPECT_EQ(arrival_comment(fate), "delayed 163.3 ms, copied, 2 bits corrupted, displaced");
}

TEST(Comments, SayHowLateADatagramLeft)
{
    EXPECT_EQ(departure_comment(7'400ns, false), "late 7 us");
    EXPECT_EQ(departure_comment(7'500ns, true), "late 8 us, copy");
}

/// Returns the output of tshark; nullopt when it is not installed.
std::optional<std::string> dissected(const std::string& capture)
{
    if (std::system("command -v tshark >/dev/null 2>&1") != 0) return std::nullopt;
    const std::string path = fmt::format("{}hapnet-{}.pcapng", testing::TempDir(), getpid());
    std::ofstream{path, std::ios::binary} << capture;
    const std::string command = fmt::format(
        "tshark -r '{}' -n -o udp.check_checksum:TRUE -o ip.check_checksum:TRUE -T fields"
        " -e frame.interface_name -e frame.packet_flags_direction -e frame.time_epoch"
        " -e ip.src -e ip.dst -e ipv6.src -e ipv6.dst -e udp.srcport -e udp.dstport"
        " -e udp.length -e ip.checksum.status -e udp.checksum.status -e frame.comment 2>/dev/null",
        path);
    std::string printed;
    FILE* const pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return std::nullopt;
    std::array<char, 4096> part{};
    while (const auto count = std::fread(part.data(), 1, part.size(), pipe)) {
        printed.append(part.data(), count);
    }
    pclose(pipe);
    std::remove(path.c_str());
    return printed;
}

TEST(Capture, HasTheMarksOfTheDatagram)
{
    CapturedPacket packet{.from = v4(1, 7000), .to = v4(9, 7001), .marks = {0xbb, 17}};
    const auto header = [&](std::size_t count) {
        std::string bytes;
        append_packet(bytes, packet, 0s, "");
        return bytes.substr(28, count); // after the block's header
    };
    EXPECT_EQ(header(2), "\x45\xbb");
    EXPECT_EQ(header(9).back(), '\x11');
    packet.marks = {};
    EXPECT_EQ(header(9).back(), '\x40'); // not known: 64, as most systems have it
    packet = {.from = v6(1, 7000), .to = v6(9, 7001), .marks = {0xbb, 17}};
    EXPECT_EQ(header(2), "\x6b\xb0");
    EXPECT_EQ(header(8).back(), '\x11');
}

TEST(Capture, IsUnderstoodByTshark)
{
    const std::vector<std::byte> hello{std::byte{'h'}, std::byte{'e'}, std::byte{'y'}};
    const std::vector<std::byte> large(CapturedPacket::payload_bytes_max - 20, std::byte{0xa5});
    // The words of this packet add up to a checksum of 0, which UDP writes as 0xffff.
    const std::vector<std::byte> zero_sum{std::byte{0xb5}, std::byte{0x1f}};
    const base::TimePoint time{1'700'000'000s + 123'456'789ns};
    std::string bytes;
    append_capture_head(bytes, "hapnet-emulator 1.0", std::array{CaptureNames{}});
    const auto a = CaptureSide::a;
    const auto b = CaptureSide::b;
    append_packet(bytes, {a, false, time, v4(1, 7000), v4(9, 7001), hello}, 0s, "delayed 160.0 ms");
    append_packet(bytes, {b, true, time + 1ns, v4(9, 7002), v4(2, 7000), large}, 0s, "late 7 us");
    append_packet(bytes, {b, false, time, v6(1, 7000), v6(9, 7001), hello}, 0s, "dropped: outage");
    append_packet(bytes, {a, true, time, mapped(1, 7000), v4(9, 7001), {}}, 0s, "late 0 us");
    append_packet(bytes, {a, true, time, mapped(1, 7000), v6(9, 7001), hello}, 0s, "late 1 us");
    append_packet(bytes, {a, false, time, v4(1, 7000), v4(9, 7001), zero_sum}, 0s, "x");
    // A packet as it was received, not as this code would write it.
    constexpr std::array<unsigned char, 32> words{
        0x45, 0x2e, 0, 32, 0, 1, 0, 0, 64, 17, 0,    0,    10,  0,   0,   1,
        10,   0,    0, 2,  0, 7, 0, 9, 0,  12, 0x13, 0x01, 'd', 'a', 't', 'a'};
    const auto whole = std::as_bytes(std::span{words});
    append_packet(bytes, {.side = b, .at = time, .payload = whole, .is_ip = true}, 0s, "whole");
    const auto printed = dissected(bytes);
    if (!printed) GTEST_SKIP() << "tshark is not installed";
    const std::string second = "1700000000.123456789";
    EXPECT_EQ(*printed, "side A\t0x00000001\t" + second +
                            "\t10.0.0.1\t10.0.0.9\t\t\t7000\t7001\t11\t1\t1\tdelayed 160.0 ms\n"
                            "side B\t0x00000002\t1700000000.123456790"
                            "\t10.0.0.9\t10.0.0.2\t\t\t7002\t7000\t65515\t1\t1\tlate 7 us\n"
                            "side B\t0x00000001\t" +
                            second +
                            "\t\t\tfd00::1\tfd00::9\t7000\t7001\t11\t\t1\tdropped: outage\n"
                            "side A\t0x00000002\t" +
                            second +
                            "\t10.0.0.1\t10.0.0.9\t\t\t7000\t7001\t8\t1\t1\tlate 0 us\n"
                            "side A\t0x00000002\t" +
                            second +
                            "\t\t\t::ffff:10.0.0.1\tfd00::9\t7000\t7001\t11\t\t1\tlate 1 us\n"
                            "side A\t0x00000001\t" +
                            second +
                            "\t10.0.0.1\t10.0.0.9\t\t\t7000\t7001\t10\t1\t1\tx\n"
                            "side B\t0x00000001\t" +
                            second + "\t10.0.0.1\t10.0.0.2\t\t\t7\t9\t12\t0\t1\twhole\n");
}

} // namespace
} // namespace hapnet::emulator
