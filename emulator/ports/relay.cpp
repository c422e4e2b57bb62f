// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/ports/relay.hpp"

#include "proto/base/ensure.hpp"
#include "proto/net/clock.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <utility>

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
        if (count_ == 0) return;
        const auto& destination = to_.filter.address();
        base::ensure(destination.has_value()); // without one, no datagram is admitted
        const auto outcomes = to_.socket.send_batch(*destination, {bytes_.data(), count_});
        const auto at = net::monotonic_now();
        for (std::size_t i = 0; i < count_; ++i) {
            if (outcomes[i] == net::SendOutcome::sent) {
                on_sent(departures_[i], at, *destination);
            } else {
                path_.on_failed(direction_, departures_[i], cause_of(outcomes[i]));
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
            from.on_stranger(datagram.from, datagram.at, is_own);
            continue;
        }
        if (sender == Sender::adopted) ++adopted;
        const Admission admission = path_.on_packet(from.direction, datagram.bytes, datagram.at,
                                                    to.filter.address().has_value());
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

void Relay::Side::on_stranger(const net::Endpoint& who, base::TimePoint at, bool is_own)
{
    ++strangers;
    if (!notice.permits(at)) return;
    stranger = Stranger{who, filter.address(), filter.heard_at(), filter.adopts(), is_own, at};
}

Relay::Relay(const Endpoints& endpoints, EmulatedPath& path, Recorder& recorder)
    : path_{path},
      recorder_{recorder},
      a_{CaptureSide::a, endpoints.listen_a, endpoints.a, path.link(Direction::up)},
      b_{CaptureSide::b, endpoints.listen_b, endpoints.b, path.link(Direction::down)}
{}

namespace {

std::string notice_of(const Relay::Side& side, const Relay::Stranger& stranger)
{
    const char name = side.side == CaptureSide::a ? 'a' : 'b';
    const auto said = fmt::format("{} sends to --listen-{} {}", stranger.who.to_text(), name,
                                  side.local.to_text());
    if (stranger.is_own) {
        return fmt::format("{}: dropped, as it names the emulator's own address as its sender",
                           said);
    }
    if (!stranger.adopts) {
        return fmt::format(
            "{0}: dropped, as only {1} may; to let it in, start again with --{2} {3}", said,
            stranger.owner->to_text(), name, stranger.who.to_text());
    }
    const std::chrono::duration<double, std::milli> ago{stranger.at - stranger.owner_heard};
    return fmt::format("{}: dropped, as {} has that side and was heard {:.0f} ms ago; another "
                       "sender is taken when it has been silent for 1 s",
                       said, stranger.owner->to_text(), ago.count());
}

} // namespace

std::optional<std::string> Relay::next_notice()
{
    for (Side* side : {&a_, &b_}) {
        if (const auto stranger = std::exchange(side->stranger, std::nullopt)) {
            return notice_of(*side, *stranger);
        }
    }
    return std::nullopt;
}

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
