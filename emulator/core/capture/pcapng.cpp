// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/capture/pcapng.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <iterator>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

constexpr std::uint32_t section_header = 0x0a0d0d0a;
constexpr std::uint32_t interface_description = 1;
constexpr std::uint32_t enhanced_packet = 6;
constexpr std::uint16_t link_type_raw = 101; // an IPv4 or IPv6 header comes first

enum Option : std::uint16_t {
    end_of_options = 0,
    packet_comment = 1,
    interface_name = 2,       // in an interface description
    packet_flags = 2,         // in a packet
    user_application = 4,     // in a section header
    timestamp_resolution = 9, // in an interface description
};

/// Appends an unsigned integer in the byte order of the file, which is little-endian.
template <typename T>
void put(std::string& bytes, T value)
{
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xffU);
    }
}

/// Appends 16 bits in network byte order.
void put_net16(std::string& bytes, std::size_t value)
{
    bytes += static_cast<char>(value >> 8 & 0xffU);
    bytes += static_cast<char>(value & 0xffU);
}

std::string_view text_of(std::span<const std::byte> bytes)
{
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; // NOLINT(*-reinterpret-*)
}

void pad(std::string& bytes, std::size_t length) { bytes.append((4 - length % 4) % 4, '\0'); }

void put_option(std::string& bytes, Option option, std::string_view value)
{
    base::ensure(value.size() <= 0xffff);
    put(bytes, static_cast<std::uint16_t>(option));
    put(bytes, static_cast<std::uint16_t>(value.size()));
    bytes += value;
    pad(bytes, value.size());
}

/// One block. Its length is at its beginning and at its end.
class Block {
public:
    Block(std::string& bytes, std::uint32_t type) : bytes_{bytes}, start_{bytes.size()}
    {
        put(bytes_, type);
        put(bytes_, std::uint32_t{0}); // replaced by the length later
    }
    ~Block()
    {
        put(bytes_, std::uint32_t{end_of_options});
        const auto length = static_cast<std::uint32_t>(bytes_.size() - start_ + 4);
        put(bytes_, length);
        for (std::size_t i = 0; i < 4; ++i) bytes_[start_ + 4 + i] = bytes_[bytes_.size() - 4 + i];
    }
    Block(const Block&) = delete;
    Block& operator=(const Block&) = delete;

private:
    std::string& bytes_;
    std::size_t start_;
};

constexpr std::size_t v4_header_bytes = 20;
constexpr std::size_t udp_header_bytes = 8;
constexpr char udp_protocol = 17;

/// The beginning of an IPv4 address in IPv6 notation.
constexpr std::string_view mapped_prefix{"\0\0\0\0\0\0\0\0\0\0\xff\xff", 12};

std::string_view v4_bytes(const UdpAddress& address)
{
    const auto bytes = text_of(address.address);
    return bytes.substr(address.is_v6 ? mapped_prefix.size() : 0, 4);
}

bool is_v4(const UdpAddress& address)
{
    return !address.is_v6 || text_of(address.address).starts_with(mapped_prefix);
}

void put_v6(std::string& bytes, const UdpAddress& address)
{
    if (address.is_v6) {
        bytes += text_of(address.address);
    } else {
        bytes += mapped_prefix;
        bytes += v4_bytes(address);
    }
}

/// Returns the sum of 16-bit words whose complement is the checksum of IP and UDP (RFC 1071).
std::uint64_t word_sum(std::string_view bytes)
{
    const auto value = [&](std::size_t i) -> std::uint64_t {
        return static_cast<unsigned char>(bytes[i]);
    };
    std::uint64_t sum = 0;
    std::size_t i = 0;
    for (; i + 1 < bytes.size(); i += 2) sum += value(i) << 8 | value(i + 1);
    if (i < bytes.size()) sum += value(i) << 8;
    return sum;
}

std::uint16_t checksum_of(std::uint64_t sum)
{
    while (sum > 0xffff) sum = (sum & 0xffff) + (sum >> 16);
    return static_cast<std::uint16_t>(~sum & 0xffff);
}

void set_net16(std::string& bytes, std::size_t at, std::uint16_t value)
{
    bytes[at] = static_cast<char>(value >> 8);
    bytes[at + 1] = static_cast<char>(value & 0xff);
}

char hop_limit_of(const CapturedPacket& packet)
{
    constexpr std::uint8_t usual = 64;
    return static_cast<char>(packet.marks.hop_limit == 0 ? usual : packet.marks.hop_limit);
}

void put_v4_header(std::string& bytes, const CapturedPacket& packet)
{
    const auto start = bytes.size();
    put_net16(bytes, 0x4500U | packet.marks.traffic_class); // version 4, five words
    put_net16(bytes, v4_header_bytes + udp_header_bytes + packet.payload.size());
    put_net16(bytes, 0);      // no identification: the packet is atomic (RFC 6864)
    put_net16(bytes, 0x4000); // do not fragment
    bytes += hop_limit_of(packet);
    bytes += udp_protocol;
    put_net16(bytes, 0);
    bytes += v4_bytes(packet.from);
    bytes += v4_bytes(packet.to);
    const auto sum = word_sum(std::string_view{bytes}.substr(start));
    set_net16(bytes, start + 10, checksum_of(sum));
}

void put_v6_header(std::string& bytes, const CapturedPacket& packet)
{
    put_net16(bytes, 0x6000U | unsigned{packet.marks.traffic_class} << 4U); // version 6
    put_net16(bytes, 0);
    put_net16(bytes, udp_header_bytes + packet.payload.size());
    bytes += udp_protocol;
    bytes += hop_limit_of(packet);
    put_v6(bytes, packet.from);
    put_v6(bytes, packet.to);
}

void put_ip_packet(std::string& bytes, const CapturedPacket& packet)
{
    const bool as_v4 = is_v4(packet.from) && is_v4(packet.to);
    base::ensure(packet.payload.size() + (as_v4 ? v4_header_bytes : 0) <=
                 CapturedPacket::payload_bytes_max);
    as_v4 ? put_v4_header(bytes, packet) : put_v6_header(bytes, packet);
    const auto addresses_at = bytes.size() - (as_v4 ? 8 : 32);
    const auto udp_at = bytes.size();
    const auto udp_bytes = udp_header_bytes + packet.payload.size();
    put_net16(bytes, packet.from.port);
    put_net16(bytes, packet.to.port);
    put_net16(bytes, udp_bytes);
    put_net16(bytes, 0);
    bytes += text_of(packet.payload);
    // The pseudo header: both addresses, the protocol and the length.
    const auto sum = word_sum(std::string_view{bytes}.substr(addresses_at)) +
                     static_cast<std::uint64_t>(udp_protocol) + udp_bytes;
    const auto checksum = checksum_of(sum);
    set_net16(bytes, udp_at + 6, checksum == 0 ? std::uint16_t{0xffff} : checksum);
}

void put_interface(std::string& bytes, std::string_view name)
{
    const Block block{bytes, interface_description};
    put(bytes, link_type_raw);
    put(bytes, std::uint16_t{0});
    put(bytes, std::uint32_t{0}); // packets are not cut
    put_option(bytes, interface_name, name);
    put_option(bytes, timestamp_resolution, "\x09"); // 10^-9 s
}

base::Duration::rep microseconds(base::Duration time) { return (time.count() + 500) / 1000; }

void append_delay(std::string& text, base::Duration delay)
{
    auto out = std::back_inserter(text);
    if (const auto us = microseconds(delay); us > 0 && us < 1000) {
        fmt::format_to(out, "delayed {} us", us);
    } else {
        const auto tenths = (us + 50) / 100;
        fmt::format_to(out, "delayed {}.{} ms", tenths / 10, tenths % 10);
    }
}

} // namespace

void append_capture_head(std::string& bytes, std::string_view program,
                         std::span<const CaptureNames> pairs)
{
    {
        const Block block{bytes, section_header};
        put(bytes, std::uint32_t{0x1a2b3c4d}); // magic number that shows the byte order
        put(bytes, std::uint16_t{1});          // version 1.0
        put(bytes, std::uint16_t{0});
        put(bytes, ~std::uint64_t{0}); // section length: not stated
        put_option(bytes, user_application, program);
    }
    for (const CaptureNames& names : pairs) {
        put_interface(bytes, names.a);
        put_interface(bytes, names.b);
    }
}

void append_packet(std::string& bytes, const CapturedPacket& packet, base::Duration since_1970,
                   std::string_view comment)
{
    const Block block{bytes, enhanced_packet};
    put(bytes, 2 * packet.pair + static_cast<std::uint32_t>(packet.side));
    const auto time =
        static_cast<std::uint64_t>((packet.at.time_since_epoch() + since_1970).count());
    put(bytes, static_cast<std::uint32_t>(time >> 32));
    put(bytes, static_cast<std::uint32_t>(time));
    const auto lengths_at = bytes.size();
    put(bytes, std::uint64_t{0}); // replaced by the captured and original length later
    const auto start = bytes.size();
    if (packet.is_ip) {
        bytes += text_of(packet.payload);
    } else {
        put_ip_packet(bytes, packet);
    }
    const auto length = bytes.size() - start;
    for (std::size_t i = 0; i < 4; ++i) {
        bytes[lengths_at + i] = static_cast<char>(length >> (8 * i) & 0xffU);
        bytes[lengths_at + 4 + i] = bytes[lengths_at + i];
    }
    pad(bytes, length);
    put_option(bytes, packet_comment, comment);
    using namespace std::string_view_literals;
    put_option(bytes, packet_flags, packet.is_outbound ? "\2\0\0\0"sv : "\1\0\0\0"sv);
}

void append_arrival_comment(std::string& text, const Fate& fate)
{
    if (fate.drop) {
        text += "dropped: ";
        const auto start = static_cast<std::ptrdiff_t>(text.size());
        text += to_text(*fate.drop);
        std::replace(text.begin() + start, text.end(), '_', '-');
        return;
    }
    append_delay(text, fate.delay);
    if (fate.copy_after) text += ", copied";
    if (const int bits = fate.flips.count; bits > 0) {
        fmt::format_to(std::back_inserter(text), ", {} bit{} corrupted", bits, bits > 1 ? "s" : "");
    }
    if (fate.displacement != Displacement{}) text += ", displaced";
}

void append_departure_comment(std::string& text, base::Duration late, bool is_copy)
{
    fmt::format_to(std::back_inserter(text), "late {} us{}", microseconds(late),
                   is_copy ? ", copy" : "");
}

} // namespace hapnet::emulator
