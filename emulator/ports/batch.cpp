// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/ports/batch.hpp"

#include "proto/base/ensure.hpp"
#include "proto/net/clock.hpp"

namespace hapnet::emulator::ports {

namespace {

DropCause cause_of(net::SendOutcome outcome)
{
    switch (outcome) {
    case net::SendOutcome::sent: break;
    case net::SendOutcome::buffer_full: return DropCause::send_buffer_full;
    case net::SendOutcome::no_route: return DropCause::no_route;
    case net::SendOutcome::too_big: return DropCause::too_big;
    case net::SendOutcome::refused: return DropCause::refused;
    case net::SendOutcome::failed: return DropCause::send_failed;
    }
    base::ensure(false);
    return DropCause::send_failed;
}

} // namespace

PacketFacts facts_of(const net::Received& datagram, const std::optional<net::Endpoint>& destination)
{
    constexpr std::uint16_t udp = 17;
    constexpr std::uint32_t header_bytes = 8;
    const auto address = [](const UdpAddress& of) {
        return address_of(std::span{of.address}.first(of.is_v6 ? 16 : 4));
    };
    const UdpAddress from = udp_address_of(datagram.from);
    const Address sender = address(from);
    // A socket of IPv6 has IPv4 as ::ffff:a.b.c.d, as Address does.
    const bool is_v4 = sender.high == 0 && sender.low >> 32U == Address::ipv4_prefix >> 32U;
    PacketFacts facts{.protocol = udp,
                      .version = static_cast<std::uint8_t>(is_v4 ? 4 : 6),
                      .has_ports = true,
                      .from_port = from.port,
                      .bytes = static_cast<std::uint32_t>(datagram.bytes.size() + header_bytes +
                                                          (is_v4 ? 20 : 40)),
                      .from = sender};
    if (destination) {
        const UdpAddress to = udp_address_of(*destination);
        facts.to_port = to.port;
        facts.to = address(to);
    }
    return facts;
}

void Batch::take(const net::Received& datagram, const Entrance& entrance)
{
    EmulatedPath* path = &way_.path;
    std::uint32_t recorded_as = way_.recorded_as;
    base::TimePoint at = datagram.at;
    if (Branches* branches = path->branches()) {
        at = branches->in_order(way_.direction, at);
        if (const auto flow = branches->flow_of(facts_of(datagram, exit_.destination), at)) {
            path = branches->paths()[*flow];
            recorded_as += static_cast<std::uint32_t>(*flow + 1);
        }
    }
    const Admission admission =
        path->on_packet(way_.direction, datagram.bytes, at, exit_.destination.has_value(),
                        {.marks = datagram.marks});
    way_.recorder.on_fate(recorded_as, way_.direction, admission.number, admission.fate);
    if (way_.recorder.captures()) {
        Fate fate = admission.fate;
        fate.drop = admission.drop;
        way_.recorder.on_arrival({.side = entrance.side,
                                  .is_outbound = false,
                                  .at = datagram.at,
                                  .from = udp_address_of(datagram.from),
                                  .to = udp_address_of(entrance.local),
                                  .payload = datagram.bytes,
                                  .pair = way_.pair,
                                  .marks = datagram.marks},
                                 fate);
    }
    if (admission.departure) add(*path, *admission.departure);
}

void Batch::flush()
{
    if (departures_.empty()) return;
    base::ensure(exit_.destination.has_value());
    const auto outcomes = exit_.socket.send_batch(*exit_.destination, bytes_.all(), marks_.all());
    const auto at = net::monotonic_now();
    for (std::size_t i = 0; i < departures_.size(); ++i) {
        if (outcomes[i] == net::SendOutcome::sent) {
            on_sent(*paths_[i], departures_[i], at);
        } else {
            paths_[i]->on_failed(way_.direction, departures_[i], cause_of(outcomes[i]));
        }
    }
    paths_.clear();
    departures_.clear();
    bytes_.clear();
    marks_.clear();
}

void Batch::on_sent(EmulatedPath& path, const Datagram& departure, base::TimePoint at)
{
    if (way_.recorder.captures()) {
        way_.recorder.on_departure({.side = exit_.side,
                                    .is_outbound = true,
                                    .at = at,
                                    .from = udp_address_of(exit_.local),
                                    .to = udp_address_of(*exit_.destination),
                                    .payload = departure.bytes,
                                    .pair = way_.pair,
                                    .marks = departure.marks},
                                   at - departure.due, departure.is_copy);
    }
    path.on_sent(way_.direction, departure, at); // frees the bytes of the datagram
}

bool send_due(const Way& way, const Exit& exit, base::TimePoint now)
{
    if (!base::is_due(way.path.link(way.direction).next_deadline(), now)) return false;
    Batch due{way, exit};
    for (std::size_t i = 0; i < net::BatchSender::batch_max; ++i) {
        const auto departure = way.path.poll(way.direction, now);
        if (!departure) {
            due.flush();
            return false;
        }
        due.add(way.path, *departure);
    }
    return true;
}

void send_due(const Way& up, const Exit& up_exit, const Way& down, const Exit& down_exit,
              base::TimePoint now)
{
    bool has_more_up = true;
    bool has_more_down = true;
    for (int round = 0; round < release_rounds_max && (has_more_up || has_more_down); ++round) {
        if (has_more_up) has_more_up = send_due(up, up_exit, now);
        if (has_more_down) has_more_down = send_due(down, down_exit, now);
    }
}

} // namespace hapnet::emulator::ports
