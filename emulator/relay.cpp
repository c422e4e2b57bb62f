// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/relay.hpp"

#include "proto/base/ensure.hpp"
#include "proto/net/clock.hpp"

#include <utility>

namespace hapnet::emulator {

namespace {

Link link_of(const Conditions& conditions, base::Seed seed, Direction direction)
{
    return Link{pipeline_of(conditions, seed, direction), conditions.order};
}

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

int receive_from(Relay::Side& side)
{
    int adopted = 0;
    for (const net::Received& datagram : side.socket.receive()) {
        const Sender sender = side.correspondent.judge(datagram.from, datagram.at);
        if (sender == Sender::stranger) {
            ++side.strangers;
            continue;
        }
        if (sender == Sender::adopted) ++adopted;
        side.link.on_packet(datagram.bytes, datagram.at);
    }
    return adopted;
}

void send_due(Relay::Side& from, Relay::Side& to, base::TimePoint now)
{
    while (auto datagram = from.link.poll(now)) {
        const auto& destination = to.correspondent.address();
        if (!destination) {
            from.link.on_failed(*std::move(datagram), DropCause::no_destination);
            continue;
        }
        const auto outcome = to.socket.send(*destination, datagram->bytes);
        if (outcome == net::SendOutcome::sent) {
            from.link.on_sent(*std::move(datagram), net::monotonic_now());
        } else {
            from.link.on_failed(*std::move(datagram), cause_of(outcome));
        }
    }
}

} // namespace

Relay::Side::Side(const net::Endpoint& listen, const std::optional<net::Endpoint>& peer,
                  Link direction)
    : socket{listen}, correspondent{peer}, link{std::move(direction)}
{}

Relay::Relay(const Places& places, const Options& options)
    : a_{places.listen_a, places.a, link_of(options.up, options.seed, Direction::up)},
      b_{places.listen_b, places.b, link_of(options.down, options.seed, Direction::down)}
{}

int Relay::receive() { return receive_from(a_) + receive_from(b_); }

void Relay::release(base::TimePoint now)
{
    send_due(a_, b_, now);
    send_due(b_, a_, now);
}

std::optional<base::TimePoint> Relay::next_deadline() const
{
    return base::earlier(a_.link.next_deadline(), b_.link.next_deadline());
}

} // namespace hapnet::emulator
