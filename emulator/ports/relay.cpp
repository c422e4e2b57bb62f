// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/ports/relay.hpp"

#include "proto/base/ensure.hpp"
#include "proto/net/clock.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

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

/// Batches of each direction that one release() sends at most. Twice what one receive() takes with
/// a copy of each: a flood cannot fill the queue by being taken faster than it is sent, and what
/// it left behind there shrinks while it goes on.
constexpr int release_rounds_max = 32;

/// What leaves in one direction: gathered and sent together. Flush it before the bytes go.
class Batch {
public:
    Batch(Link& link, Relay::Side& to, Recorder& recorder)
        : link_{link}, to_{to}, recorder_{recorder}
    {}

    void add(const Departure& departure)
    {
        departures_[count_] = departure;
        bytes_[count_] = departure.bytes;
        ++count_;
        if (is_full()) flush();
    }

    void flush()
    {
        const auto& destination = to_.correspondent.address();
        if (count_ > 0 && destination) {
            const auto outcomes = to_.socket.send_batch(*destination, {bytes_.data(), count_});
            const auto at = net::monotonic_now();
            for (std::size_t i = 0; i < count_; ++i) {
                if (outcomes[i] == net::SendOutcome::sent) {
                    on_sent(departures_[i], at, *destination);
                } else {
                    link_.on_failed(departures_[i], cause_of(outcomes[i]));
                }
            }
        } else {
            for (std::size_t i = 0; i < count_; ++i) {
                link_.on_failed(departures_[i], DropCause::no_destination);
            }
        }
        count_ = 0;
    }

private:
    [[nodiscard]] bool is_full() const { return count_ == departures_.size(); }

    void on_sent(const Departure& departure, base::TimePoint at, const net::Endpoint& destination)
    {
        if (recorder_.captures()) {
            recorder_.on_departure({to_.side, at, udp_address_of(to_.local),
                                    udp_address_of(destination), departure.bytes},
                                   at - departure.due, departure.is_copy);
        }
        link_.on_sent(departure, at); // its bytes go
    }

    Link& link_;
    Relay::Side& to_;
    Recorder& recorder_;
    std::size_t count_ = 0;
    std::array<Departure, net::BatchSender::batch_max> departures_;
    std::array<std::span<const std::byte>, net::BatchSender::batch_max> bytes_;
};

Link link_of(const Relay::Setup& setup, Direction direction)
{
    const bool is_up = direction == Direction::up;
    Link::Setup link{setup.seed, direction, setup.start, {}, {}};
    if (setup.replay) {
        const auto& fates = is_up ? setup.replay->up : setup.replay->down;
        link.replay.emplace(std::shared_ptr<const std::vector<Fate>>{setup.replay, &fates});
    }
    return Link{is_up ? setup.path.up : setup.path.down, link};
}

} // namespace

int Relay::pass(Side& from, Side& to, Director& director)
{
    const auto arrived = from.socket.receive();
    if (arrived.empty()) return 0;
    int adopted = 0;
    const Direction direction = from.side == CaptureSide::a ? Direction::up : Direction::down;
    Batch undelayed{from.link, to, recorder_};
    for (const net::Received& datagram : arrived) {
        // What seems to come from ourselves is forged: adopted, it would go round for ever.
        const bool is_own = datagram.from == from.local || datagram.from == to.local;
        const Sender sender =
            is_own ? Sender::stranger : from.correspondent.judge(datagram.from, datagram.at);
        if (sender == Sender::stranger) {
            ++from.strangers;
            continue;
        }
        if (sender == Sender::adopted) ++adopted;
        if (director.advance(datagram.at)) change(director.path(), datagram.at);
        const Admission admission = from.link.on_packet(datagram.bytes, datagram.at);
        recorder_.on_fate(direction, admission.number, admission.fate);
        if (recorder_.captures()) {
            recorder_.on_arrival({from.side, datagram.at, udp_address_of(datagram.from),
                                  udp_address_of(from.local), datagram.bytes},
                                 {admission.verdict, {}});
        }
        if (admission.departure) undelayed.add(*admission.departure);
    }
    undelayed.flush();
    return adopted;
}

/// Sends at most one batch of what is due; returns whether it was a whole one.
bool Relay::send_due(Side& from, Side& to, base::TimePoint now)
{
    if (!base::is_due(from.link.next_deadline(), now)) return false;
    Batch due{from.link, to, recorder_};
    for (std::size_t i = 0; i < net::BatchSender::batch_max; ++i) {
        const auto departure = from.link.poll(now);
        if (!departure) {
            due.flush();
            return false;
        }
        due.add(*departure);
    }
    return true;
}

Relay::Side::Side(CaptureSide which, const net::Endpoint& listen,
                  const std::optional<net::Endpoint>& peer, Link from_here)
    : side{which},
      socket{listen, net::Load::bulk},
      local{socket.local()},
      correspondent{peer},
      link{std::move(from_here)}
{}

Relay::Relay(const Places& places, const Setup& setup, Recorder& recorder)
    : recorder_{recorder},
      a_{CaptureSide::a, places.listen_a, places.a, link_of(setup, Direction::up)},
      b_{CaptureSide::b, places.listen_b, places.b, link_of(setup, Direction::down)}
{}

int Relay::receive(Director& director) { return pass(a_, b_, director) + pass(b_, a_, director); }

void Relay::release(base::TimePoint now)
{
    bool a_has_more = true;
    bool b_has_more = true;
    for (int round = 0; round < release_rounds_max && (a_has_more || b_has_more); ++round) {
        if (a_has_more) a_has_more = send_due(a_, b_, now);
        if (b_has_more) b_has_more = send_due(b_, a_, now);
    }
}

void Relay::change(const Path& path, base::TimePoint now)
{
    a_.link.change(path.up, now);
    b_.link.change(path.down, now);
}

std::optional<base::TimePoint> Relay::next_deadline() const
{
    return base::earlier(a_.link.next_deadline(), b_.link.next_deadline());
}

} // namespace hapnet::emulator
