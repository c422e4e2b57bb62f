// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/capture_file.hpp"

#include "emulator/core/frame.hpp"

#include <algorithm>
#include <optional>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator::tools {

namespace {

using Bytes = std::span<const std::byte>;

std::uint32_t big(Bytes bytes, std::size_t at, std::size_t count)
{
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
        value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
    }
    return value;
}

/// Reads numbers in the byte order of the program that wrote the file.
struct ByteOrder {
    bool is_big = false;

    [[nodiscard]] std::uint32_t u32(Bytes bytes, std::size_t at) const { return of(bytes, at, 4); }
    [[nodiscard]] std::uint32_t u16(Bytes bytes, std::size_t at) const { return of(bytes, at, 2); }

private:
    [[nodiscard]] std::uint32_t of(Bytes bytes, std::size_t at, std::size_t count) const
    {
        if (is_big) return big(bytes, at, count);
        std::uint32_t value = 0;
        for (std::size_t i = count; i-- > 0;) {
            value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
        }
        return value;
    }
};

constexpr std::uint32_t pcap_microseconds = 0xa1b2'c3d4;
constexpr std::uint32_t pcap_nanoseconds = 0xa1b2'3c4d;
constexpr std::uint32_t pcapng_section = 0x0a0d'0d0a; // equal in both byte orders
constexpr std::uint32_t pcapng_order = 0x1a2b'3c4d;

// https://www.tcpdump.org/linktypes.html
enum LinkType : std::uint32_t {
    link_null = 0,
    link_ethernet = 1,
    link_raw_bsd = 12,
    link_raw = 101,
    link_loop = 108,
    link_cooked = 113,
    link_ipv4 = 228,
    link_ipv6 = 229,
    link_cooked_2 = 276,
};

bool is_readable(std::uint32_t link)
{
    constexpr std::array readable{link_null,   link_ethernet, link_raw_bsd, link_raw,     link_loop,
                                  link_cooked, link_ipv4,     link_ipv6,    link_cooked_2};
    return std::ranges::find(readable, link) != readable.end();
}

/// Returns the IP packet of a frame; empty when there is none.
Bytes ip_packet_of(std::uint32_t link, Bytes frame)
{
    const auto behind = [&](std::size_t header) {
        return frame.size() > header ? frame.subspan(header) : Bytes{};
    };
    switch (link) {
    case link_ethernet: {
        const Frame read = read_frame(frame);
        return read.kind == FrameKind::ip ? behind(read.header_bytes) : Bytes{};
    }
    case link_null:
    case link_loop: return behind(4);
    case link_cooked: return behind(16);
    case link_cooked_2: return behind(20);
    default: return frame;
    }
}

/// The payload after the headers of IP: its captured bytes, and its length on the wire.
struct IpPayload {
    std::uint8_t protocol = 0;
    Bytes captured{};
    std::size_t bytes = 0;
    PacketFlow flow{};
};

PacketEnd end_of(Bytes address)
{
    PacketEnd end{.is_v6 = address.size() == 16};
    std::ranges::copy(address, end.address.begin());
    return end;
}

std::optional<IpPayload> read_ipv4(Bytes packet)
{
    constexpr std::uint32_t offset_and_more = 0x3fff; // nonzero: the packet is a fragment
    if (packet.size() < 20 || (big(packet, 6, 2) & offset_and_more) != 0) return std::nullopt;
    const std::size_t header = std::size_t{4} * (big(packet, 0, 1) & 0xfU);
    std::size_t total = big(packet, 2, 2);
    if (total == 0) total = packet.size(); // a segment that the interface will divide
    if (header < 20 || packet.size() < header || total < header) return std::nullopt;
    const auto captured = packet.first(std::min(packet.size(), total)).subspan(header);
    return IpPayload{.protocol = std::to_integer<std::uint8_t>(packet[9]),
                     .captured = captured,
                     .bytes = total - header,
                     .flow = {{}, end_of(packet.subspan(12, 4)), end_of(packet.subspan(16, 4))}};
}

std::optional<IpPayload> read_ipv6(Bytes packet)
{
    constexpr std::size_t header = 40;
    constexpr int extensions_max = 4;
    if (packet.size() < header) return std::nullopt;
    std::size_t bytes = big(packet, 4, 2);
    if (bytes == 0) bytes = packet.size() - header;
    IpPayload payload{.protocol = std::to_integer<std::uint8_t>(packet[6]),
                      .captured = packet.subspan(header, std::min(bytes, packet.size() - header)),
                      .bytes = bytes,
                      .flow = {{}, end_of(packet.subspan(8, 16)), end_of(packet.subspan(24, 16))}};
    const auto is_extension = [&] { // hop-by-hop, routing, or destination options
        return payload.protocol == 0 || payload.protocol == 43 || payload.protocol == 60;
    };
    for (int i = 0; i < extensions_max && is_extension(); ++i) {
        if (payload.captured.size() < 8) return std::nullopt;
        const std::size_t length = 8 * (1 + std::size_t{big(payload.captured, 1, 1)});
        if (length > payload.captured.size()) return std::nullopt;
        payload.protocol = std::to_integer<std::uint8_t>(payload.captured[0]);
        payload.captured = payload.captured.subspan(length);
        payload.bytes -= length;
    }
    return payload;
}

std::optional<IpPayload> read_ip(Bytes packet)
{
    if (packet.empty()) return std::nullopt;
    switch (big(packet, 0, 1) >> 4) {
    case 4: return read_ipv4(packet);
    case 6: return read_ipv6(packet);
    default: return std::nullopt;
    }
}

/// Returns the packet without its `header`.
std::optional<SeenPacket> behind(const IpPayload& ip, PacketProtocol protocol, std::size_t header)
{
    if (ip.captured.size() < header) return std::nullopt;
    SeenPacket packet{.flow = ip.flow,
                      .payload = ip.captured.subspan(header),
                      .payload_bytes = ip.bytes - header};
    packet.flow.protocol = protocol;
    return packet;
}

std::optional<SeenPacket> read_echo(const IpPayload& ip, bool is_v6)
{
    auto packet = behind(ip, PacketProtocol::echo, 8);
    if (!packet) return packet;
    const auto type = big(ip.captured, 0, 1);
    const bool is_one = is_v6 ? type == 128 || type == 129 : type == 8 || type == 0;
    if (!is_one || big(ip.captured, 1, 1) != 0) return std::nullopt;
    packet->flow.from.port = packet->flow.to.port =
        static_cast<std::uint16_t>(big(ip.captured, 4, 2));
    packet->number = big(ip.captured, 6, 2);
    return packet;
}

std::optional<SeenPacket> read_tcp(const IpPayload& ip)
{
    if (ip.captured.size() < 20) return std::nullopt;
    const std::size_t header = std::size_t{4} * (big(ip.captured, 12, 1) >> 4);
    if (header < 20 || ip.bytes <= header) return std::nullopt;
    auto packet = behind(ip, PacketProtocol::tcp, header);
    if (packet) packet->number = big(ip.captured, 4, 4);
    return packet;
}

std::optional<SeenPacket> read_packet(Bytes bytes)
{
    const auto ip = read_ip(bytes);
    if (!ip) return std::nullopt;
    if (ip->protocol == 1 || ip->protocol == 58) return read_echo(*ip, ip->protocol == 58);
    auto packet = ip->protocol == 6    ? read_tcp(*ip)
                  : ip->protocol == 17 ? behind(*ip, PacketProtocol::udp, 8)
                                       : std::nullopt;
    if (!packet) return packet;
    packet->flow.from.port = static_cast<std::uint16_t>(big(ip->captured, 0, 2));
    packet->flow.to.port = static_cast<std::uint16_t>(big(ip->captured, 2, 2));
    return packet;
}

/// An interface of a capture.
struct Interface {
    std::uint32_t link = 0;
    std::uint64_t steps = 1'000'000; // steps of its clock in a second
    bool is_binary = false;          // steps is a power of two, not of ten
    std::int64_t offset_s = 0;
};

/// Returns the time of this number of steps since 1970; nullopt: too far away.
std::optional<base::Duration> time_of(const Interface& interface, std::uint64_t steps)
{
    constexpr std::uint64_t exact = std::uint64_t{1} << 32;
    constexpr std::int64_t seconds_max = 4'000'000'000;
    std::uint64_t each = interface.steps;
    const std::uint64_t whole = steps / each;
    std::uint64_t rest = steps % each;
    for (const std::uint64_t by = interface.is_binary ? 2 : 10; each > exact; each /= by)
        rest /= by;
    if (whole > static_cast<std::uint64_t>(seconds_max)) return std::nullopt;
    const auto seconds = static_cast<std::int64_t>(whole) + interface.offset_s;
    if (seconds < 0 || seconds > seconds_max) return std::nullopt;
    return base::Duration{std::chrono::seconds{seconds}} +
           base::Duration{static_cast<base::Duration::rep>(rest * 1'000'000'000U / each)};
}

/// Collects packets in the order of a file.
class Collector {
public:
    /// `which`: the number of the interface in the whole file.
    [[nodiscard]] base::Result<void> add(const Interface& interface, std::uint32_t which,
                                         std::uint64_t steps, Bytes frame)
    {
        ++seen_;
        const auto at = time_of(interface, steps);
        if (!at) return fail("its time is before 1970 or after 2096");
        auto packet = read_packet(ip_packet_of(interface.link, frame));
        if (!packet) {
            ++capture_.passed_over;
            return {};
        }
        if (capture_.packets.size() == captured_packets_max) {
            return fail("there are more than 2000000: cut the file, for example with editcap -c");
        }
        packet->at = *at;
        packet->interface = which;
        capture_.packets.push_back(*packet);
        return {};
    }
    /// Returns an error that names the next packet. For use before add(), or at the end.
    [[nodiscard]] tl::unexpected<base::Error> fail_next(const std::string& why)
    {
        ++seen_;
        return fail(why);
    }
    void end_within_packet() { capture_.cut_off_in = seen_ + 1; }
    [[nodiscard]] Capture finished() { return std::move(capture_); }

private:
    [[nodiscard]] tl::unexpected<base::Error> fail(const std::string& why) const
    {
        return base::fail(fmt::format("packet {}: {}", seen_, why));
    }

    Capture capture_;
    std::size_t seen_ = 0;
};

std::string refusal_of_link(std::uint32_t link)
{
    return fmt::format("its interface has the link type {}; Ethernet, raw IP, Linux cooked and "
                       "loopback can be read",
                       link);
}

std::string refusal_of_fraction(std::uint64_t fraction, std::uint64_t steps, bool is_big_endian)
{
    constexpr std::uint64_t microseconds = 1'000'000;
    constexpr std::uint64_t nanoseconds = 1'000'000'000;
    const auto text = fmt::format("its time is {} of {} parts of a second", fraction, steps);
    if (steps != microseconds || fraction >= nanoseconds) return text + ": damaged";
    return fmt::format("{}: the head of the file says microseconds, but its times are nanoseconds; "
                       "write {} over its first four bytes, or save it as pcapng",
                       text, is_big_endian ? "a1 b2 3c 4d" : "4d 3c b2 a1");
}

constexpr std::size_t frame_bytes_max = std::size_t{1} << 20;

base::Result<Capture> read_pcap(Bytes bytes)
{
    constexpr std::size_t head = 24;
    constexpr std::size_t record = 16;
    Collector collector;
    const ByteOrder order{big(bytes, 0, 4) == pcap_microseconds ||
                          big(bytes, 0, 4) == pcap_nanoseconds};
    if (bytes.size() < head) return collector.fail_next("the head of the file is cut off");
    Interface interface {
        .link = order.u32(bytes, 20) & 0xffffU
    };
    if (order.u32(bytes, 0) == pcap_nanoseconds) interface.steps = 1'000'000'000;
    if (!is_readable(interface.link)) return collector.fail_next(refusal_of_link(interface.link));
    for (auto left = bytes.subspan(head); !left.empty();) {
        if (left.size() < record) {
            collector.end_within_packet();
            break;
        }
        const std::size_t captured = order.u32(left, 8);
        if (captured > frame_bytes_max) {
            return collector.fail_next(fmt::format("it has {} bytes: damaged", captured));
        }
        if (left.size() - record < captured) {
            collector.end_within_packet();
            break;
        }
        const std::uint64_t fraction = order.u32(left, 4);
        if (fraction >= interface.steps) {
            return collector.fail_next(
                refusal_of_fraction(fraction, interface.steps, order.is_big));
        }
        const std::uint64_t steps = order.u32(left, 0) * interface.steps + fraction;
        const auto added = collector.add(interface, 0, steps, left.subspan(record, captured));
        if (!added) return tl::unexpected{added.error()};
        left = left.subspan(record + captured);
    }
    return collector.finished();
}

/// Reads the blocks of a pcapng file one after the other.
class PcapngReader {
public:
    explicit PcapngReader(Bytes bytes) : left_{bytes} {}

    [[nodiscard]] base::Result<Capture> read()
    {
        while (left_.size() >= block_bytes_min) {
            if (const auto taken = take_block(); !taken) return tl::unexpected{taken.error()};
        }
        if (!left_.empty()) collector_.end_within_packet();
        return collector_.finished();
    }

private:
    static constexpr std::size_t block_bytes_min = 12;

    [[nodiscard]] base::Result<void> take_block()
    {
        const bool is_section = big(left_, 0, 4) == pcapng_section;
        if (is_section) {
            order_.is_big = big(left_, 8, 4) == pcapng_order;
            if (order_.u32(left_, 8) != pcapng_order) {
                return collector_.fail_next("the section before it has no byte order: damaged");
            }
            first_of_section_ += static_cast<std::uint32_t>(interfaces_.size());
            interfaces_.clear();
        }
        const std::size_t length = order_.u32(left_, 4);
        if (length < block_bytes_min || length % 4 != 0) {
            return collector_.fail_next(fmt::format("a block has {} bytes: damaged", length));
        }
        if (length > left_.size()) {
            collector_.end_within_packet();
            left_ = {};
            return {};
        }
        const auto type = order_.u32(left_, 0);
        const auto body = left_.subspan(8, length - block_bytes_min);
        left_ = left_.subspan(length);
        constexpr std::uint32_t interface_description = 1;
        constexpr std::uint32_t simple_packet = 3;
        constexpr std::uint32_t enhanced_packet = 6;
        if (type == interface_description) return take_interface(body);
        if (type == enhanced_packet) return take_packet(body);
        if (type == simple_packet) return collector_.fail_next("it has no time");
        return {};
    }

    [[nodiscard]] base::Result<void> take_interface(Bytes body)
    {
        if (body.size() < 8) return collector_.fail_next("an interface is cut off");
        constexpr std::size_t interfaces_max = 1024;
        if (interfaces_.size() == interfaces_max) {
            return collector_.fail_next("there are more than 1024 interfaces");
        }
        Interface interface {
            .link = order_.u16(body, 0)
        };
        for (auto options = body.subspan(8); options.size() >= 4;) {
            const auto code = order_.u16(options, 0);
            const std::size_t length = order_.u16(options, 2);
            const std::size_t padded = 4 + (length + 3) / 4 * 4;
            if (code == 0 || padded > options.size()) break;
            const auto value = options.subspan(4, length);
            if (code == 9 && length == 1 && !take_resolution(interface, big(value, 0, 1))) {
                return collector_.fail_next("the steps of its clock are too small");
            }
            if (code == 14 && length == 8) {
                const auto low = order_.u32(value, order_.is_big ? 4 : 0);
                const auto high = order_.u32(value, order_.is_big ? 0 : 4);
                const auto offset =
                    static_cast<std::int64_t>(std::uint64_t{high} << 32U | std::uint64_t{low});
                constexpr std::int64_t most = 4'000'000'000;
                interface.offset_s = std::clamp(offset, -most, most);
            }
            options = options.subspan(padded);
        }
        interfaces_.push_back(interface);
        return {};
    }

    /// Reads if_tsresol: a power of ten, or of two if the highest bit is set.
    [[nodiscard]] static bool take_resolution(Interface& interface, std::uint32_t code)
    {
        constexpr std::uint32_t binary = 0x80;
        interface.is_binary = (code & binary) != 0;
        const std::uint32_t power = code & ~binary;
        if (power > (interface.is_binary ? 63U : 18U)) return false;
        interface.steps = 1;
        for (std::uint32_t i = 0; i < power; ++i) interface.steps *= interface.is_binary ? 2 : 10;
        return true;
    }

    [[nodiscard]] base::Result<void> take_packet(Bytes body)
    {
        constexpr std::size_t head = 20;
        if (body.size() < head) return collector_.fail_next("its head is cut off");
        const auto which = order_.u32(body, 0);
        if (which >= interfaces_.size()) return collector_.fail_next("it is of no interface");
        const Interface& interface = interfaces_[which];
        if (!is_readable(interface.link)) {
            return collector_.fail_next(refusal_of_link(interface.link));
        }
        const std::size_t captured = order_.u32(body, 12);
        if (captured > body.size() - head || captured > frame_bytes_max) {
            return collector_.fail_next(fmt::format("it has {} bytes: damaged", captured));
        }
        const std::uint64_t steps =
            std::uint64_t{order_.u32(body, 4)} << 32U | std::uint64_t{order_.u32(body, 8)};
        return collector_.add(interface, first_of_section_ + which, steps,
                              body.subspan(head, captured));
    }

    Bytes left_;
    ByteOrder order_;
    std::vector<Interface> interfaces_; // interfaces of this section
    std::uint32_t first_of_section_ = 0;
    Collector collector_;
};

std::string address_text(const PacketEnd& end)
{
    const Bytes address{end.address};
    if (!end.is_v6) {
        return fmt::format("{}.{}.{}.{}", big(address, 0, 1), big(address, 1, 1),
                           big(address, 2, 1), big(address, 3, 1));
    }
    std::string text;
    for (std::size_t i = 0; i < address.size(); i += 2) {
        text += fmt::format("{}{:x}", i == 0 ? "" : ":", big(address, i, 2));
    }
    return text;
}

} // namespace

std::string to_text(const PacketFlow& flow)
{
    const auto from = address_text(flow.from);
    const auto to = address_text(flow.to);
    if (flow.protocol == PacketProtocol::echo) return fmt::format("ping {} > {}", from, to);
    const bool is_v6 = flow.from.is_v6;
    return fmt::format("{} {}{}{}:{} > {}{}{}:{}",
                       flow.protocol == PacketProtocol::tcp ? "TCP" : "UDP", is_v6 ? "[" : "", from,
                       is_v6 ? "]" : "", flow.from.port, is_v6 ? "[" : "", to, is_v6 ? "]" : "",
                       flow.to.port);
}

bool is_capture(std::string_view bytes)
{
    if (bytes.size() < 4) return false;
    const Bytes first = std::as_bytes(std::span{bytes.data(), 4});
    const auto either = [&](std::uint32_t magic) {
        return ByteOrder{true}.u32(first, 0) == magic || ByteOrder{false}.u32(first, 0) == magic;
    };
    return either(pcap_microseconds) || either(pcap_nanoseconds) || either(pcapng_section);
}

base::Result<Capture> read_capture(std::string_view text)
{
    const Bytes bytes = std::as_bytes(std::span{text.data(), text.size()});
    if (bytes.size() >= 4 && big(bytes, 0, 4) == pcapng_section) return PcapngReader{bytes}.read();
    if (is_capture(text)) return read_pcap(bytes);
    return base::fail("packet 1: the file is neither pcap nor pcapng");
}

} // namespace hapnet::emulator::tools
