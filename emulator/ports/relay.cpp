// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/ports/relay.hpp"

#include <chrono>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator::ports {

/// Returns the reason why the datagram may not pass; nullopt: it is from the side's peer, which may
/// be a new one.
std::optional<Relay::Refusal> Relay::refusal_of(Side& from, const net::Received& datagram)
{
    if (from.filter.address() != datagram.from) {
        // A datagram that seems to come from this program is forged. If its address were adopted,
        // it would go round for ever.
        if (own_.contains(datagram.from)) return Refusal::is_own;
        if (from.allowed && !from.allowed->contains(datagram.from)) return Refusal::not_allowed;
    }
    switch (from.filter.classify(datagram.from, datagram.at)) {
    case Sender::known: return std::nullopt;
    case Sender::adopted: has_adopted_ = true; return std::nullopt;
    case Sender::unknown: break;
    }
    return from.filter.adopts() ? Refusal::side_is_taken : Refusal::not_the_peer;
}

void Relay::pass(Side& from, Side& to)
{
    const auto arrived = from.socket.receive();
    if (arrived.empty()) return;
    Batch undelayed{way(path_, from.direction), to.exit()};
    for (const net::Received& datagram : arrived) {
        if (const auto refusal = refusal_of(from, datagram)) {
            from.on_stranger(datagram, *refusal);
            continue;
        }
        paths_.advance(datagram.at);
        undelayed.take(datagram, from.entrance());
    }
    undelayed.flush();
}

Relay::Side::Side(CaptureSide which, const Endpoints& endpoints, const Link& from_here)
    : side{which},
      direction{which == CaptureSide::a ? Direction::up : Direction::down},
      socket{which == CaptureSide::a ? endpoints.listen_a : endpoints.listen_b, net::Load::bulk},
      local{socket.local()},
      filter{which == CaptureSide::a ? endpoints.a : endpoints.b},
      allowed{which == CaptureSide::a ? endpoints.allowed_a : endpoints.allowed_b},
      link{from_here}
{}

void Relay::Side::on_stranger(const net::Received& datagram, Refusal why)
{
    ++strangers;
    if (!notice.permits(datagram.at)) return;
    stranger = Stranger{datagram.from, filter.address(), filter.heard_at(), why, datagram.at};
}

Relay::Relay(const Endpoints& endpoints, Paths& paths, const Among& among)
    : name_{among.name},
      paths_{paths},
      path_{paths.add(among.name)},
      recorder_{among.recorder},
      number_{among.number},
      recorded_as_{among.recorded_as},
      own_{among.own},
      a_{CaptureSide::a, endpoints, path_.link(Direction::up)},
      b_{CaptureSide::b, endpoints, path_.link(Direction::down)}
{
    own_.add(a_.local);
    own_.add(b_.local);
}

namespace {

std::string notice_of(const std::string& link, const Relay::Side& side,
                      const Relay::Stranger& stranger)
{
    const bool is_a = side.side == CaptureSide::a;
    const auto place = link.empty() ? fmt::format("--listen-{}", is_a ? 'a' : 'b')
                                    : fmt::format("LISTEN_{} of --link {}", is_a ? 'A' : 'B', link);
    const auto said =
        fmt::format("{} sends to {} {}", stranger.who.to_text(), place, side.local.to_text());
    switch (stranger.why) {
    case Relay::Refusal::is_own:
        return fmt::format("{}: dropped, as it names the emulator's own address as its sender",
                           said);
    case Relay::Refusal::not_allowed:
        return fmt::format("{}: dropped, as {} does not name it", said,
                           link.empty() ? fmt::format("--{}", is_a ? 'a' : 'b')
                                        : fmt::format("END_{}", is_a ? 1 : 2));
    case Relay::Refusal::not_the_peer:
        return fmt::format("{}: dropped, as only {} may; to let it in, start again with {} {}",
                           said, stranger.owner->to_text(),
                           link.empty() ? fmt::format("--{}", is_a ? 'a' : 'b')
                                        : fmt::format("END_{}", is_a ? 1 : 2),
                           stranger.who.to_text());
    case Relay::Refusal::side_is_taken: break;
    }
    const std::chrono::duration<double, std::milli> ago{stranger.at - stranger.owner_heard};
    return fmt::format("{}: dropped, as {} has that side and was heard {:.0f} ms ago; another "
                       "sender is taken when it has been silent for 1 s",
                       said, stranger.owner->to_text(), ago.count());
}

std::string who(const Relay::Side& side)
{
    const auto& address = side.filter.address();
    return address ? address->to_text() : std::string{"not known yet"};
}

} // namespace

std::optional<std::string> Relay::next_notice()
{
    if (std::exchange(has_adopted_, false)) {
        return fmt::format("{}A is {}, B is {}", name_.empty() ? "" : name_ + ": ", who(a_),
                           who(b_));
    }
    for (Side* side : {&a_, &b_}) {
        if (const auto stranger = std::exchange(side->stranger, std::nullopt)) {
            return notice_of(name_, *side, *stranger);
        }
    }
    return std::nullopt;
}

void Relay::receive()
{
    pass(a_, b_);
    pass(b_, a_);
}

void Relay::release(EmulatedPath& path, base::TimePoint now)
{
    send_due(way(path, Direction::up), b_.exit(), way(path, Direction::down), a_.exit(), now);
}

} // namespace hapnet::emulator::ports
