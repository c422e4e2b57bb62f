// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/relay.hpp"

#include "proto/base/ensure.hpp"
#include "proto/net/clock.hpp"

#include <utility>

namespace hapnet::emulator {

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

void send_now(Link& link, Relay::Side& to, const Departure& departure)
{
    const auto& destination = to.correspondent.address();
    if (!destination) return link.on_failed(departure, DropCause::no_destination);
    const auto outcome = to.socket.send(*destination, departure.bytes);
    if (outcome == net::SendOutcome::sent) {
        link.on_sent(departure, net::monotonic_now());
    } else {
        link.on_failed(departure, cause_of(outcome));
    }
}

int pass(Relay::Side& from, Relay::Side& to)
{
    int adopted = 0;
    for (const net::Received& datagram : from.socket.receive()) {
        const Sender sender = from.correspondent.judge(datagram.from, datagram.at);
        if (sender == Sender::stranger) {
            ++from.strangers;
            continue;
        }
        if (sender == Sender::adopted) ++adopted;
        const Admission admission = from.link.on_packet(datagram.bytes, datagram.at);
        if (admission.departure) send_now(from.link, to, *admission.departure);
    }
    return adopted;
}

void send_due(Relay::Side& from, Relay::Side& to, base::TimePoint now)
{
    while (const auto departure = from.link.poll(now)) send_now(from.link, to, *departure);
}

} // namespace

Relay::Side::Side(const net::Endpoint& listen, const std::optional<net::Endpoint>& peer,
                  Link direction)
    : socket{listen}, correspondent{peer}, link{std::move(direction)}
{}

Relay::Relay(const Places& places, const Options& options)
    : start_{net::monotonic_now()},
      a_{places.listen_a, places.a,
         Link{options.path.up, {options.seed, Direction::up, start_, {}}}},
      b_{places.listen_b, places.b,
         Link{options.path.down, {options.seed, Direction::down, start_, {}}}}
{}

int Relay::receive() { return pass(a_, b_) + pass(b_, a_); }

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
