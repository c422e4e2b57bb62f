// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/too_big.hpp"

#include "emulator/core/frame.hpp"
#include "emulator/core/network_bytes.hpp"

#include <algorithm>
#include <array>

namespace hapnet::emulator {

namespace {

constexpr std::size_t icmp_header_bytes = 8;
constexpr std::byte hops{64};

/// The properties of the answers of one address family: the offset of the addresses, and the
/// greatest length.
struct Family {
    std::size_t header_bytes;
    std::size_t addresses_at; // offset of the source address; the destination follows
    std::size_t address_bytes;
    std::size_t mtu_min;          // RFC 791, RFC 8200
    std::size_t answer_bytes_max; // RFC 1812, 4.3.2.3; RFC 4443, 2.4
};
constexpr Family v4{20, 12, 4, 68, 576};
constexpr Family v6{40, 8, 16, 1280, 1280};

std::span<const std::byte> source_of(std::span<const std::byte> packet, const Family& family)
{
    return packet.subspan(family.addresses_at, family.address_bytes);
}

std::span<const std::byte> destination_of(std::span<const std::byte> packet, const Family& family)
{
    return packet.subspan(family.addresses_at + family.address_bytes, family.address_bytes);
}

bool is_nothing(std::span<const std::byte> address)
{
    return std::ranges::all_of(address, [](std::byte byte) { return byte == std::byte{0}; });
}

/// True for an ICMP error. Answers to errors could continue for ever.
bool is_icmp_error(std::span<const std::byte> packet)
{
    constexpr std::array errors{3, 4, 5, 11, 12};
    const std::size_t header = std::size_t{4} * (at8(packet, 0) & 0xfU);
    return at8(packet, 9) == 1 &&
           (packet.size() <= header ||
            std::ranges::find(errors, int{at8(packet, header)}) != errors.end());
}

bool is_answered_v4(std::span<const std::byte> packet)
{
    constexpr std::uint8_t group_first = 224; // this and all higher first bytes
    constexpr unsigned must_not_be_fragmented = 0x4000;
    constexpr unsigned offset = 0x1fff;
    if (packet.size() < v4.header_bytes || at8(packet, 0) >> 4 != 4) return false;
    const unsigned fragment = at16(packet, 6);
    const auto source = source_of(packet, v4);
    return (fragment & must_not_be_fragmented) != 0 && (fragment & offset) == 0 &&
           at8(destination_of(packet, v4), 0) < group_first && at8(source, 0) < group_first &&
           !is_nothing(source) && !is_icmp_error(packet);
}

bool is_answered_v6(std::span<const std::byte> packet)
{
    constexpr std::uint8_t group = 0xff;
    constexpr std::uint8_t icmp = 58;
    constexpr std::uint8_t information_first = 128; // first ICMPv6 type that is not an error
    if (packet.size() <= v6.header_bytes || at8(packet, 0) >> 4 != 6) return false;
    const auto source = source_of(packet, v6);
    const bool is_error =
        at8(packet, 6) == icmp && at8(packet, v6.header_bytes) < information_first;
    return at8(destination_of(packet, v6), 0) != group && at8(source, 0) != group &&
           !is_nothing(source) && !is_error;
}

void put_v4(std::span<std::byte> answer, std::size_t mtu)
{
    constexpr std::uint8_t internetwork_control = 0xc0; // RFC 1812, 4.3.2.5
    constexpr std::uint16_t type_and_code = 0x0304;     // fragmentation needed
    answer[0] = std::byte{0x45};
    answer[1] = std::byte{internetwork_control};
    put16(answer, 2, static_cast<std::uint16_t>(answer.size()));
    answer[8] = hops;
    answer[9] = std::byte{1};
    put16(answer, v4.header_bytes, type_and_code);
    put16(answer, v4.header_bytes + 6,
          static_cast<std::uint16_t>(std::min(mtu, std::size_t{0xffff})));
}

void put_v6(std::span<std::byte> answer, std::size_t mtu)
{
    constexpr std::uint16_t type_and_code = 0x0200; // packet too big
    answer[0] = std::byte{0x60};
    put16(answer, 4, static_cast<std::uint16_t>(answer.size() - v6.header_bytes));
    answer[6] = std::byte{58};
    answer[7] = hops;
    put16(answer, v6.header_bytes, type_and_code);
    put16(answer, v6.header_bytes + 4, static_cast<std::uint16_t>(mtu >> 16));
    put16(answer, v6.header_bytes + 6, static_cast<std::uint16_t>(mtu & 0xffff));
}

} // namespace

std::vector<std::byte> too_big_answer(std::span<const std::byte> frame, std::size_t mtu)
{
    const Frame read = read_frame(frame);
    const auto packet = frame.subspan(read.header_bytes);
    const bool is_v4 = is_answered_v4(packet);
    const Family& family = is_v4 ? v4 : v6;
    const bool is_to_a_group = !frame.empty() && (frame[0] & std::byte{1}) != std::byte{0};
    if (read.kind != FrameKind::ip || is_to_a_group || packet.size() <= mtu ||
        mtu < family.mtu_min || !(is_v4 || is_answered_v6(packet))) {
        return {};
    }
    const std::size_t bytes = std::min(
        {family.answer_bytes_max, mtu, family.header_bytes + icmp_header_bytes + packet.size()});
    std::vector<std::byte> answer(read.header_bytes + bytes);
    std::ranges::copy(read.source, answer.begin());        // destination: the sender
    std::ranges::copy(frame.first(6), answer.begin() + 6); // source: the frame's destination
    std::ranges::copy(frame.subspan(12, read.header_bytes - std::size_t{12}), answer.begin() + 12);
    const auto ip = std::span{answer}.subspan(read.header_bytes);
    if (is_v4) {
        put_v4(ip, mtu);
    } else {
        put_v6(ip, mtu);
    }
    std::ranges::copy(destination_of(packet, family), ip.subspan(family.addresses_at).begin());
    std::ranges::copy(source_of(packet, family),
                      ip.subspan(family.addresses_at + family.address_bytes).begin());
    const auto quoted = ip.subspan(family.header_bytes + icmp_header_bytes);
    std::ranges::copy(packet.first(quoted.size()), quoted.begin());
    fix_checksums(answer);
    return answer;
}

} // namespace hapnet::emulator
