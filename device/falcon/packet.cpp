// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/falcon/packet.hpp"

#include "proto/base/ensure.hpp"

namespace hapnet::device::falcon {

namespace {

constexpr std::byte opening{'<'};
constexpr std::byte closing{'>'};
constexpr unsigned zero = 'A';
constexpr std::size_t nibbles_each = 4;
constexpr std::size_t flags_at = 13;
constexpr std::size_t rest_at = 14;
constexpr unsigned home_flag = 0x1;
constexpr unsigned lights_mask = 0xe;
constexpr unsigned buttons_mask = 0xf;
constexpr unsigned homed_shift = 4;

bool is_framed(std::span<const std::byte, packet_bytes> bytes)
{
    return bytes.front() == opening && bytes.back() == closing;
}

/// Returns the number at this position; nullopt when it is more than `most`.
std::optional<unsigned> number_at(std::span<const std::byte, packet_bytes> bytes, std::size_t at,
                                  unsigned most)
{
    const auto byte = std::to_integer<unsigned>(bytes[at]);
    if (byte < zero || byte > zero + most) return std::nullopt;
    return byte - zero;
}

std::optional<Counts> counts_in(std::span<const std::byte, packet_bytes> bytes)
{
    Counts counts{};
    std::size_t at = 1;
    for (std::int16_t& count : counts) {
        unsigned value = 0;
        for (std::size_t i = 0; i < nibbles_each; ++i, ++at) {
            const auto nibble = number_at(bytes, at, 0xf);
            if (!nibble) return std::nullopt;
            value |= *nibble << (4 * i);
        }
        count = static_cast<std::int16_t>(static_cast<std::uint16_t>(value));
    }
    return counts;
}

Packet packet_of(const Counts& counts, unsigned flags, unsigned rest)
{
    Packet packet{};
    packet.front() = opening;
    packet.back() = closing;
    std::size_t at = 1;
    for (const std::int16_t count : counts) {
        const auto value = static_cast<std::uint16_t>(count);
        for (std::size_t i = 0; i < nibbles_each; ++i, ++at) {
            packet[at] = static_cast<std::byte>(zero + ((value >> (4 * i)) & 0xfU));
        }
    }
    packet[flags_at] = static_cast<std::byte>(zero + flags);
    packet[rest_at] = static_cast<std::byte>(rest);
    return packet;
}

} // namespace

Packet encode(const Command& command)
{
    const auto lights = static_cast<unsigned>(command.lights);
    base::ensure((lights & ~lights_mask) == 0);
    return packet_of(command.motors, lights | (command.home ? home_flag : 0), zero);
}

Packet encode(const Report& report)
{
    const unsigned homed = static_cast<unsigned>(report.legs_homed) << homed_shift;
    base::ensure(report.buttons <= buttons_mask && report.legs_homed <= all_legs);
    base::ensure(report.rest != std::to_integer<unsigned>(opening) &&
                 report.rest != std::to_integer<unsigned>(closing));
    return packet_of(report.encoders, homed | report.buttons, report.rest);
}

std::optional<Report> decode_report(std::span<const std::byte, packet_bytes> bytes)
{
    const auto encoders = counts_in(bytes);
    const auto flags = number_at(bytes, flags_at, unsigned{all_legs} << homed_shift | buttons_mask);
    const std::byte rest = bytes[rest_at];
    if (!is_framed(bytes) || !encoders || !flags || rest == opening || rest == closing) {
        return std::nullopt;
    }
    return Report{.encoders = *encoders,
                  .buttons = static_cast<std::uint8_t>(*flags & buttons_mask),
                  .legs_homed = static_cast<std::uint8_t>(*flags >> homed_shift),
                  .rest = std::to_integer<std::uint8_t>(rest)};
}

std::optional<Command> decode_command(std::span<const std::byte, packet_bytes> bytes)
{
    const auto motors = counts_in(bytes);
    const auto flags = number_at(bytes, flags_at, lights_mask | home_flag);
    if (!is_framed(bytes) || !motors || !flags || !number_at(bytes, rest_at, 0)) {
        return std::nullopt;
    }
    return Command{.motors = *motors,
                   .lights = static_cast<Lights>(*flags & lights_mask),
                   .home = (*flags & home_flag) != 0};
}

std::optional<Packet> PacketFinder::feed(std::byte byte)
{
    // '<' occurs only at the beginning of a packet, so the bytes before it were no packet.
    if (byte == opening) {
        skipped_ += size_;
        size_ = 0;
    } else if (size_ == 0) {
        ++skipped_;
        return std::nullopt;
    }
    packet_[size_++] = byte;
    if (size_ < packet_bytes && byte != closing) return std::nullopt;
    const bool is_whole = size_ == packet_bytes && byte == closing;
    if (!is_whole) skipped_ += size_;
    size_ = 0;
    if (!is_whole) return std::nullopt;
    return packet_;
}

} // namespace hapnet::device::falcon
