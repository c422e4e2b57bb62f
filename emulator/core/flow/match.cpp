// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/flow/match.hpp"

#include "emulator/core/flow/packet_facts.hpp"
#include "proto/base/fields.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

namespace {

/// A number that has a name.
struct NamedNumber {
    std::string_view name;
    std::uint16_t number;
};

constexpr std::array<NamedNumber, 12> protocols{{{"icmp", 1},
                                                 {"igmp", 2},
                                                 {"tcp", 6},
                                                 {"udp", 17},
                                                 {"gre", 47},
                                                 {"esp", 50},
                                                 {"icmpv6", 58},
                                                 {"ospf", 89},
                                                 {"sctp", 132},
                                                 {"udplite", 136},
                                                 {"arp", PacketFacts::arp}}};
constexpr std::size_t protocol_names = 11;
constexpr std::uint16_t protocol_max = 255;

/// Code points of RFC 2474, 2597, 3246, 5865, 8622.
constexpr std::array<NamedNumber, 25> code_points{
    {{"be", 0},    {"le", 1},    {"cs1", 8},   {"cs2", 16},  {"cs3", 24},
     {"cs4", 32},  {"cs5", 40},  {"cs6", 48},  {"cs7", 56},  {"af11", 10},
     {"af12", 12}, {"af13", 14}, {"af21", 18}, {"af22", 20}, {"af23", 22},
     {"af31", 26}, {"af32", 28}, {"af33", 30}, {"af41", 34}, {"af42", 36},
     {"af43", 38}, {"ef", 46},   {"va", 44},   {"df", 0},    {"cs0", 0}}};
constexpr std::uint16_t code_point_max = 63;

/// Reads a name in `known`, or a number up to `most`.
template <typename Number>
void read_named(const base::Node& node, std::span<const NamedNumber> known, std::uint16_t most,
                Number& target, base::Reading& reading)
{
    const auto* text = std::get_if<std::string>(&node.value);
    if (text == nullptr) {
        const auto number = base::count_of(node, most);
        if (number) {
            target = static_cast<Number>(*number);
            return;
        }
        return base::complain_of(
            node, fmt::format("a name such as \"{}\", or a number to {}", known.front().name, most),
            reading);
    }
    const auto found = std::ranges::find(known, *text, &NamedNumber::name);
    if (found != known.end()) {
        target = static_cast<Number>(found->number);
        return;
    }
    std::vector<std::string_view> names;
    for (const NamedNumber& one : known) names.push_back(one.name);
    reading.complain(node.place,
                     fmt::format("unknown name {}: {}, or a number to {}", base::in_quotes(*text),
                                 base::suggestion(*text, names), most));
}

std::string named_text(std::uint16_t value, std::span<const NamedNumber> known)
{
    const auto found = std::ranges::find(known, value, &NamedNumber::number);
    return found == known.end() ? fmt::format("{}", value) : base::quoted(found->name);
}

/// Reads two numbers with `separator` between them. An end that is missing is open, if
/// `may_be_open`.
std::optional<NumberRange> parse_range(std::string_view text, std::string_view separator,
                                       bool may_be_open)
{
    NumberRange range;
    const auto at = text.find(separator);
    if (at == std::string_view::npos) return std::nullopt;
    const auto read = [&](std::string_view part, std::uint16_t& target) {
        if (part.empty()) return may_be_open;
        const auto number = base::parse_count(part, std::numeric_limits<std::uint16_t>::max());
        if (number) target = static_cast<std::uint16_t>(*number);
        return number.has_value();
    };
    const bool is_read = read(text.substr(0, at), range.first) &&
                         read(text.substr(at + separator.size()), range.last);
    return is_read && text != separator && range.first <= range.last ? std::optional{range}
                                                                     : std::nullopt;
}

void read_range(const base::Node& node, std::string_view separator, std::string_view expected,
                NumberRange& target, base::Reading& reading)
{
    constexpr std::uint16_t most = std::numeric_limits<std::uint16_t>::max();
    const auto* text = std::get_if<std::string>(&node.value);
    std::optional<NumberRange> range;
    if (text != nullptr) {
        range = parse_range(*text, separator, separator == "..");
    } else if (const auto number = base::count_of(node, most)) {
        range = {static_cast<std::uint16_t>(*number), static_cast<std::uint16_t>(*number)};
    }
    if (!range) return base::complain_of(node, expected, reading);
    target = *range;
}

void read_net(const base::Node& node, Net& target, base::Reading& reading)
{
    const auto* text = std::get_if<std::string>(&node.value);
    if (text == nullptr) return base::complain_of(node, "an address in quotes", reading);
    const auto net = Net::parse(*text);
    if (!net) return reading.complain(node.place, net.error().message);
    target = *net;
}

bool is_empty(const NumberRange& range) { return range.first > range.last; }

} // namespace

void ProtocolFormat::read(const base::Node& node, std::uint16_t& target,
                          base::Reading& reading) const
{
    read_named(node, std::span{protocols}.first(protocol_names), protocol_max, target, reading);
}
std::string ProtocolFormat::print(std::uint16_t value) const
{
    return named_text(value, std::span{protocols}.first(protocol_names));
}
std::string ProtocolFormat::describe() const
{
    return "udp, tcp, icmp, icmpv6, arp, or a number to 255";
}

void PortsFormat::read(const base::Node& node, NumberRange& target, base::Reading& reading) const
{
    read_range(node, "-", "a port such as 5004, or ports such as \"5000-5100\"", target, reading);
}
std::string PortsFormat::print(const NumberRange& value) const
{
    if (value.first == value.last) return fmt::format("{}", value.first);
    return base::quoted(fmt::format("{}-{}", value.first, value.last));
}

void SizesFormat::read(const base::Node& node, NumberRange& target, base::Reading& reading) const
{
    read_range(node, "..", "bytes such as \"..100\", \"1000..\" or \"100..200\"", target, reading);
}
std::string SizesFormat::print(const NumberRange& value) const
{
    const NumberRange all;
    if (value.first == value.last) return fmt::format("{}", value.first);
    const auto first = value.first == all.first ? "" : fmt::format("{}", value.first);
    const bool is_open = value.last == all.last && !first.empty();
    return base::quoted(fmt::format("{}..{}", first, is_open ? "" : fmt::format("{}", value.last)));
}

void DscpFormat::read(const base::Node& node, std::uint8_t& target, base::Reading& reading) const
{
    read_named(node, code_points, code_point_max, target, reading);
}
std::string DscpFormat::print(std::uint8_t value) const { return named_text(value, code_points); }

void IpVersionFormat::read(const base::Node& node, std::uint8_t& target,
                           base::Reading& reading) const
{
    const auto number = base::count_of(node, 6);
    if (!number || (*number != 4 && *number != 6)) {
        return base::complain_of(node, "4 or 6", reading);
    }
    target = static_cast<std::uint8_t>(*number);
}
std::string IpVersionFormat::print(std::uint8_t value) const { return fmt::format("{}", value); }

void HostFormat::read(const base::Node& node, Net& target, base::Reading& reading) const
{
    Net host;
    read_net(node, host, reading);
    if (!reading.is_good()) return;
    if (!host.is_single()) {
        return reading.complain(node.place, fmt::format("{} is a network: write net = {}",
                                                        host.text(), base::quoted(host.text())));
    }
    target = host;
}
std::string HostFormat::print(const Net& value) const { return base::quoted(value.text()); }

void NetFormat::read(const base::Node& node, Net& target, base::Reading& reading) const
{
    read_net(node, target, reading);
}
std::string NetFormat::print(const Net& value) const { return base::quoted(value.text()); }

base::Result<void> validate(const Match& match)
{
    if (match == Match{}) {
        return base::fail("it would take every packet: write what belongs to the flow, such as "
                          "match = { protocol = \"udp\", port = 5004 }");
    }
    if (match.port && match.ports) {
        return base::fail("port and ports say the same: write one of them");
    }
    const bool asks_for_ip = Match{.protocol = match.protocol} != match;
    if (match.protocol == PacketFacts::arp && asks_for_ip) {
        return base::fail("an ARP message has none of what the other keys ask for: write protocol "
                          "alone");
    }
    for (const auto& range :
         {match.port, match.ports, match.to_port, match.from_port, match.size}) {
        if (range && is_empty(*range)) return base::fail("the range ends before it begins");
    }
    return {};
}

} // namespace hapnet::emulator
