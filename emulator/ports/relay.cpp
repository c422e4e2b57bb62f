// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/ports/relay.hpp"

#include <chrono>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator::ports {

int Relay::pass(Side& from, Side& to)
{
    const auto arrived = from.socket.receive();
    if (arrived.empty()) return 0;
    int adopted = 0;
    Batch undelayed{path_, from.direction, to.exit(), recorder_};
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
        if (a_has_more) a_has_more = send_due(path_, Direction::up, b_.exit(), recorder_, now);
        if (b_has_more) b_has_more = send_due(path_, Direction::down, a_.exit(), recorder_, now);
    }
}

} // namespace hapnet::emulator::ports
