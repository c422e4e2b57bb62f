// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/ports/relay.hpp"

#include "proto/base/ensure.hpp"
#include "proto/net/clock.hpp"

#include <array>
#include <cstddef>
#include <span>

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

/// Batches of each direction that one release() sends at most. Twice what one receive() takes with
/// a copy of each: a flood cannot fill the queue by being taken faster than it is sent, and what
/// it left behind there shrinks while it goes on.
constexpr int release_rounds_max = 32;

/// What leaves in one direction: gathered and sent together. Flush it before the bytes go.
class Batch {
public:
    Batch(EmulatedPath& path, Direction direction, Relay::Side& to, Recorder& recorder)
        : path_{path}, direction_{direction}, to_{to}, recorder_{recorder}
    {}

    void add(const Datagram& departure)
    {
        departures_[count_] = departure;
        bytes_[count_] = departure.bytes;
        ++count_;
        if (is_full()) flush();
    }

    void flush()
    {
        const auto& destination = to_.filter.address();
        if (count_ > 0 && destination) {
            const auto outcomes = to_.socket.send_batch(*destination, {bytes_.data(), count_});
            const auto at = net::monotonic_now();
            for (std::size_t i = 0; i < count_; ++i) {
                if (outcomes[i] == net::SendOutcome::sent) {
                    on_sent(departures_[i], at, *destination);
                } else {
                    path_.on_failed(direction_, departures_[i], cause_of(outcomes[i]));
                }
            }
        } else {
            for (std::size_t i = 0; i < count_; ++i) {
                path_.on_failed(direction_, departures_[i], DropCause::no_destination);
            }
        }
        count_ = 0;
    }

private:
    [[nodiscard]] bool is_full() const { return count_ == departures_.size(); }

    void on_sent(const Datagram& departure, base::TimePoint at, const net::Endpoint& destination)
    {
        if (recorder_.captures()) {
            recorder_.on_departure({.side = to_.side,
                                    .is_outbound = true,
                                    .at = at,
                                    .from = udp_address_of(to_.local),
                                    .to = udp_address_of(destination),
                                    .payload = departure.bytes},
                                   at - departure.due, departure.is_copy);
        }
        path_.on_sent(direction_, departure, at); // its bytes go
    }

    EmulatedPath& path_;
    Direction direction_;
    Relay::Side& to_;
    Recorder& recorder_;
    std::size_t count_ = 0;
    std::array<Datagram, net::BatchSender::batch_max> departures_;
    std::array<std::span<const std::byte>, net::BatchSender::batch_max> bytes_;
};

} // namespace

int Relay::pass(Side& from, Side& to)
{
    const auto arrived = from.socket.receive();
    if (arrived.empty()) return 0;
    int adopted = 0;
    Batch undelayed{path_, from.direction, to, recorder_};
    for (const net::Received& datagram : arrived) {
        // What seems to come from ourselves is forged: adopted, it would go round for ever.
        const bool is_own = datagram.from == from.local || datagram.from == to.local;
        const Sender sender =
            is_own ? Sender::unknown : from.filter.classify(datagram.from, datagram.at);
        if (sender == Sender::unknown) {
            ++from.strangers;
            continue;
        }
        if (sender == Sender::adopted) ++adopted;
        const Admission admission = path_.on_packet(from.direction, datagram.bytes, datagram.at);
        recorder_.on_fate(from.direction, admission.number, admission.fate);
        if (recorder_.captures()) {
            Fate fate = admission.fate;
            fate.drop = admission.drop;
            recorder_.on_arrival({.side = from.side,
                                  .is_outbound = false,
                                  .at = datagram.at,
                                  .from = udp_address_of(datagram.from),
                                  .to = udp_address_of(from.local),
                                  .payload = datagram.bytes},
                                 fate);
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
    Batch due{path_, from.direction, to, recorder_};
    for (std::size_t i = 0; i < net::BatchSender::batch_max; ++i) {
        const auto departure = path_.poll(from.direction, now);
        if (!departure) {
            due.flush();
            return false;
        }
        due.add(*departure);
    }
    return true;
}

Relay::Side::Side(CaptureSide which, const net::Endpoint& listen,
                  const std::optional<net::Endpoint>& peer, const Link& from_here)
    : side{which},
      direction{which == CaptureSide::a ? Direction::up : Direction::down},
      socket{listen, net::Load::bulk},
      local{socket.local()},
      filter{peer},
      link{from_here}
{}

Relay::Relay(const Endpoints& endpoints, EmulatedPath& path, Recorder& recorder)
    : path_{path},
      recorder_{recorder},
      a_{CaptureSide::a, endpoints.listen_a, endpoints.a, path.link(Direction::up)},
      b_{CaptureSide::b, endpoints.listen_b, endpoints.b, path.link(Direction::down)}
{}

int Relay::receive() { return pass(a_, b_) + pass(b_, a_); }

void Relay::release(base::TimePoint now)
{
    bool a_has_more = true;
    bool b_has_more = true;
    for (int round = 0; round < release_rounds_max && (a_has_more || b_has_more); ++round) {
        if (a_has_more) a_has_more = send_due(a_, b_, now);
        if (b_has_more) b_has_more = send_due(b_, a_, now);
    }
}

} // namespace hapnet::emulator::ports
