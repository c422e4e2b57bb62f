// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/captures.hpp"

#include "emulator/tools/probe_message.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <spdlog/fmt/fmt.h>
#include <unordered_map>
#include <utility>

namespace hapnet::emulator::tools {

namespace {

using Packets = std::vector<const SeenPacket*>;

constexpr std::size_t matched_min = 2;
constexpr auto everything = std::numeric_limits<std::size_t>::max();

/// A hash of 64 bits (FNV-1a). Among a million payloads, two have equal hashes with a probability
/// of 3 in 10^8.
class PayloadHash {
public:
    void add(std::span<const std::byte> bytes)
    {
        for (const std::byte byte : bytes) add_byte(std::to_integer<std::uint64_t>(byte));
    }
    void add(std::uint64_t number)
    {
        for (int shift = 0; shift < 64; shift += 8) add_byte(number >> shift & 0xffU);
    }
    [[nodiscard]] std::uint64_t value() const { return hash_; }

private:
    void add_byte(std::uint64_t byte) { hash_ = (hash_ ^ byte) * 0x100'0000'01b3U; }

    std::uint64_t hash_ = 0xcbf2'9ce4'8422'2325U;
};

/// The criteria by which datagrams are identified.
struct Identity {
    std::size_t payload_bytes = everything; // bytes compared: the fewest captured of any packet
    bool is_of_exchange = false;            // a question and its answer count as equal

    [[nodiscard]] std::uint64_t of(const SeenPacket& packet) const
    {
        PayloadHash hash;
        hash.add(static_cast<std::uint64_t>(packet.flow.protocol));
        if (is_of_exchange && packet.flow.protocol == PacketProtocol::udp) {
            if (const auto message = decode_probe(packet.payload)) {
                hash.add(message->session);
                hash.add(message->sequence);
                return hash.value();
            }
        }
        hash.add(packet.number);
        hash.add(packet.payload_bytes);
        hash.add(packet.payload.first(std::min(packet.payload.size(), payload_bytes)));
        return hash.value();
    }
};

/// Returns the least number of payload bytes that were captured of any packet.
std::size_t least_captured(const Packets& packets)
{
    std::size_t least = everything;
    for (const SeenPacket* packet : packets) {
        if (packet->payload.size() == packet->payload_bytes) continue;
        least = std::min(least, packet->payload.size());
    }
    return least;
}

/// The packets that were sent, matched with those that arrived.
struct Matched {
    MeasuredWay way{};
    std::vector<base::Duration> differences{}; // differences for the packets that arrived
    std::size_t repeated = 0;                  // packets sent that share their payload with others
    std::size_t copies = 0;                    // packets that arrived again
    bool is_uneven = false;                    // the time between packets varies
};

bool is_uneven(const std::vector<base::Duration>& sent)
{
    const auto n = static_cast<double>(sent.size()) - 1.0;
    const double mean = base::to_seconds(sent.back() - sent.front()) / n;
    double squares = 0.0;
    for (std::size_t i = 1; i < sent.size(); ++i) {
        const double off = base::to_seconds(sent[i] - sent[i - 1]) - mean;
        squares += off * off;
    }
    return squares / n > 0.25 * mean * mean; // true if the deviation is more than half of the mean
}

/// Returns the packets with a unique identity. `others` is set to the number of the other packets.
std::vector<std::pair<std::uint64_t, const SeenPacket*>>
only_ones(const Packets& packets, const Identity& identity, std::size_t& others)
{
    std::unordered_map<std::uint64_t, std::size_t> counts;
    for (const SeenPacket* packet : packets) ++counts[identity.of(*packet)];
    std::vector<std::pair<std::uint64_t, const SeenPacket*>> only;
    for (const SeenPacket* packet : packets) {
        const auto id = identity.of(*packet);
        if (counts[id] == 1) only.emplace_back(id, packet);
    }
    others = packets.size() - only.size();
    std::stable_sort(only.begin(), only.end(),
                     [](const auto& a, const auto& b) { return a.second->at < b.second->at; });
    return only;
}

/// The first arrival of a payload, and the number of its arrivals.
struct Arrival {
    base::Duration at{};
    std::size_t count = 0;
};

/// Returns the number of packets that arrived after a packet that was sent later (RFC 4737, 3.3).
/// `arrivals`: the times of arrival, in the order of sending.
std::uint64_t reordered_of(const std::vector<base::Duration>& arrivals)
{
    std::uint64_t reordered = 0;
    base::Duration earliest = base::Duration::max(); // earliest arrival among those sent later
    for (std::size_t i = arrivals.size(); i-- > 0;) {
        if (arrivals[i] > earliest) ++reordered;
        earliest = std::min(earliest, arrivals[i]);
    }
    return reordered;
}

Matched match(const Packets& sent, const Packets& arrived, const Identity& identity)
{
    Matched matched;
    std::unordered_map<std::uint64_t, Arrival> arrivals;
    for (const SeenPacket* packet : arrived) {
        Arrival& arrival = arrivals[identity.of(*packet)];
        arrival.at = arrival.count++ == 0 ? packet->at : std::min(arrival.at, packet->at);
    }
    const auto only = only_ones(sent, identity, matched.repeated);
    const auto has_arrived = [&](const auto& one) { return arrivals.contains(one.first); };
    const auto first = std::find_if(only.begin(), only.end(), has_arrived);
    const auto behind = std::find_if(only.rbegin(), only.rend(), has_arrived).base();
    std::vector<base::Duration> times, arrived_at;
    for (auto one = first; one < behind; ++one) {
        times.push_back(one->second->at);
        const auto arrival = arrivals.find(one->first);
        if (arrival == arrivals.end()) {
            matched.way.add({}, true);
            continue;
        }
        const auto& [at, count] = arrival->second;
        matched.way.add(at - one->second->at, false);
        matched.differences.push_back(at - one->second->at);
        matched.copies += count - 1;
        arrived_at.push_back(at);
    }
    matched.way.reordered = reordered_of(arrived_at);
    if (times.size() < 2 || times.front() == times.back()) return matched;
    matched.way.spacing =
        (times.back() - times.front()) / static_cast<base::Duration::rep>(times.size() - 1);
    matched.is_uneven = is_uneven(times);
    return matched;
}

base::Duration median_of(std::vector<base::Duration> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

using Flows = std::map<PacketFlow, Packets>;

Flows flows_of(const Packets& packets)
{
    Flows flows;
    for (const SeenPacket* packet : packets) flows[packet->flow].push_back(packet);
    return flows;
}

Packets packets_of(const Flows& flows, const PacketFlow& flow)
{
    const auto found = flows.find(flow);
    return found == flows.end() ? Packets{} : found->second;
}

Packets all_of(const Capture& capture)
{
    Packets packets;
    for (const SeenPacket& packet : capture.packets) packets.push_back(&packet);
    return packets;
}

void remark_on(const Matched& matched, const std::string& way, std::vector<std::string>& remarks)
{
    if (matched.repeated > 0) {
        remarks.push_back(fmt::format("{}: {} datagrams are left out: others have the same payload",
                                      way, matched.repeated));
    }
    if (matched.copies > 0) {
        remarks.push_back(fmt::format("{}: {} datagrams arrived more than once; the first of each "
                                      "counts, and the profile has no duplicate",
                                      way, matched.copies));
    }
    if (matched.is_uneven) {
        remarks.push_back(fmt::format("{}: the datagrams were sent at uneven distances: "
                                      "correlation_time is a rough figure",
                                      way));
    }
}

/// A flow, with the addresses seen at the first of two ends.
struct Conversation {
    PacketFlow flow{};
    std::size_t seen_by_both = 0;
};

/// Two ends of a path.
class Ends {
public:
    Ends(const Packets& a, const Packets& b)
        : a_{flows_of(a)},
          b_{flows_of(b)},
          identity_{std::min(least_captured(a), least_captured(b))}
    {
        for (const SeenPacket* packet : b) {
            of_b_.try_emplace(identity_.of(*packet), packet->flow);
        }
    }

    /// Returns the conversation with the most datagrams that both ends have seen, in both
    /// directions together.
    [[nodiscard]] Conversation busiest() const
    {
        Conversation busiest;
        for (const auto& [flow, packets] : a_) {
            const auto count = shared(packets) + shared(packets_of(a_, flow.back()));
            if (count > busiest.seen_by_both) busiest = {flow, count};
        }
        return busiest;
    }

    [[nodiscard]] base::Result<Measurement> measure() const
    {
        const auto [flow, seen_by_both] = busiest();
        if (seen_by_both < matched_min) {
            return base::fail("the two captures share no datagrams: their payloads must differ "
                              "from one another, be captured whole (tcpdump -s 0), and pass "
                              "unchanged");
        }
        Measurement measurement;
        measurement.remarks.push_back(fmt::format("{}: both ends have seen {} of its datagrams, "
                                                  "there and back",
                                                  to_text(flow), seen_by_both));
        for (const PacketFlow& way : {flow, flow.back()}) add_way(way, measurement);
        if (!measurement.up && !measurement.down) {
            return base::fail("too many datagrams have the same payload to know them again");
        }
        settle_clocks(measurement);
        return measurement;
    }

private:
    [[nodiscard]] std::size_t shared(const Packets& packets) const
    {
        return static_cast<std::size_t>(std::ranges::count_if(
            packets, [&](const SeenPacket* one) { return of_b_.contains(identity_.of(*one)); }));
    }

    /// Returns the packets at b of the flow that contains most of these packets there.
    [[nodiscard]] Packets same_at_b(const Packets& at_a) const
    {
        std::map<PacketFlow, std::size_t> counts;
        for (const SeenPacket* packet : at_a) {
            const auto found = of_b_.find(identity_.of(*packet));
            if (found != of_b_.end()) ++counts[found->second];
        }
        const auto most =
            std::ranges::max_element(counts, {}, [](const auto& one) { return one.second; });
        return most == counts.end() ? Packets{} : packets_of(b_, most->first);
    }

    /// Adds one direction to the measurement. `way` has the addresses seen at a. The order of the
    /// two stamps shows which end is the sender. Two clocks can reverse this order, which
    /// sends_from_a() corrects if both directions are known.
    void add_way(const PacketFlow& way, Measurement& measurement) const
    {
        const Packets at_a = packets_of(a_, way);
        const Packets at_b = same_at_b(at_a);
        if (at_a.empty() || at_b.empty()) return;
        const Matched from_a = match(at_a, at_b, identity_);
        if (from_a.differences.size() < matched_min) return;
        const bool is_up = sends_from_a(way, from_a);
        const Matched matched = is_up ? from_a : match(at_b, at_a, identity_);
        if (matched.differences.size() < matched_min) return;
        auto& place = is_up ? measurement.up : measurement.down;
        if (place) return;
        place = matched.way;
        remark_on(matched, is_up ? "up" : "down", measurement.remarks);
    }

    /// True if `way` is from a. Of two directions, the one from a has the larger difference of
    /// stamps, because the difference of the clocks is added to both.
    [[nodiscard]] bool sends_from_a(const PacketFlow& way, const Matched& matched) const
    {
        const base::Duration own = median_of(matched.differences);
        const Packets back = packets_of(a_, way.back());
        const auto other = match(back, same_at_b(back), identity_);
        if (other.differences.size() < matched_min) return own >= base::Duration{};
        return own > median_of(other.differences);
    }

    Flows a_;
    Flows b_;
    Identity identity_;
    std::unordered_map<std::uint64_t, PacketFlow> of_b_;
};

/// Matches questions and answers in one capture.
base::Result<Measurement> measure_answers(const Packets& packets)
{
    const Flows flows = flows_of(packets);
    const Identity identity{least_captured(packets), /*is_of_exchange*/ true};
    Matched best;
    PacketFlow asking;
    for (const auto& [flow, sent] : flows) {
        if (flow.protocol == PacketProtocol::tcp || flow == flow.back()) continue;
        auto matched = match(sent, packets_of(flows, flow.back()), identity);
        if (matched.differences.size() <= best.differences.size()) continue;
        // A negative difference: these packets are the answers.
        if (median_of(matched.differences) < base::Duration{}) continue;
        best = std::move(matched);
        asking = flow;
    }
    if (best.differences.size() < matched_min) {
        return base::fail("no datagram has an answer that repeats it, as those of ping and of "
                          "hapnet-emulator probe do: give the capture of the other end, too");
    }
    Measurement measurement;
    measurement.remarks.push_back(
        fmt::format("{}: {} datagrams have an answer", to_text(asking), best.differences.size()));
    remark_on(best, "round trip", measurement.remarks);
    measurement.round_trip = std::move(best.way);
    return measurement;
}

} // namespace

base::Result<Measurement> measure_ends(const Capture& a, const Capture& b)
{
    return Ends{all_of(a), all_of(b)}.measure();
}

base::Result<Measurement> measure_capture(const Capture& capture)
{
    std::map<std::uint32_t, Packets> interfaces;
    for (const SeenPacket& packet : capture.packets) {
        interfaces[packet.interface].push_back(&packet);
    }
    if (interfaces.size() > 2) {
        return base::fail(fmt::format("it has packets of {} interfaces: keep one or two, for "
                                      "example with tshark -Y \"frame.interface_id < 2\" -w",
                                      interfaces.size()));
    }
    if (interfaces.size() == 2) {
        const Ends ends{interfaces.begin()->second, interfaces.rbegin()->second};
        if (ends.busiest().seen_by_both >= matched_min) return ends.measure();
    }
    return measure_answers(all_of(capture));
}

} // namespace hapnet::emulator::tools
