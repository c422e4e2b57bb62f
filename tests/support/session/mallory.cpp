// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/session/mallory.hpp"

#include "proto/secure/frames.hpp"
#include "tests/support/allocations.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>
#include <variant>

namespace hapnet::test {

namespace {

using namespace std::chrono_literals;

std::span<const std::byte> view(const std::vector<std::byte>& bytes) { return bytes; }

std::string text_of(std::span<const std::byte> bytes)
{
    std::string text(bytes.size(), '\0');
    if (!bytes.empty()) std::memcpy(text.data(), bytes.data(), bytes.size());
    return text;
}

/// Of a sealed state: its key, sequence and time; the rest is behind the seal.
constexpr std::size_t clear_head = 20;
constexpr std::size_t sequence_at = 8;

} // namespace

Mallory::Mallory(lab::virtual_time::VirtualWorld& world, base::Seed seed, const Habits& habits)
    : world_{world},
      habits_{habits},
      draw_{seed.stream("mallory")},
      given_(world.sides()),
      let_in_(world.sides()),
      runs_(world.sides())
{
    for (std::size_t to = 0; to < world.sides(); ++to) {
        for (std::size_t from = 0; from < world.sides(); ++from) {
            if (from != to)
                ways_.push_back({.from = from, .to = to, .line = from < to ? from : from - 1});
        }
    }
    world_.intercept([this](const lab::virtual_time::VirtualWorld::Arrival& arrival) {
        on_arrival(way_between(arrival.from, arrival.to), arrival.datagram, arrival.at);
    });
}

std::size_t Mallory::way_between(std::size_t from, std::size_t to) const
{
    return to * (world_.sides() - 1) + (from < to ? from : from - 1);
}

void Mallory::on_arrival(std::size_t index, std::span<const std::byte> datagram,
                         base::TimePoint arrived)
{
    Way& way = ways_[index];
    remember(way, datagram);
    if (is_there_ && happens(habits_.redirect)) {
        return give_from(way, datagram, secure::Place{std::byte{0xee}}, arrived);
    }
    if (!is_there_) return give(way, datagram, arrived);
    if (arrived < way.silent_until || happens(habits_.drop)) return;
    if (happens(habits_.copy)) hold(way, datagram);
    if (happens(habits_.hold)) return hold(way, datagram);
    const bool flips = happens(habits_.flip);
    const bool resizes = happens(habits_.resize);
    if (!flips && !resizes) return give(way, datagram, arrived);
    Bytes bytes{datagram.begin(), datagram.end()};
    if (flips) damage(bytes);
    if (resizes) bytes.resize(below(bytes.size() + 20));
    give(way, bytes, arrived);
}

/// Keeps an even choice of all that ever went this way (reservoir sampling, J. S. Vitter 1985).
void Mallory::remember(Way& way, std::span<const std::byte> datagram)
{
    if (const auto message = wire::decode(datagram)) {
        if (const auto* state = std::get_if<wire::State>(&*message)) way.state = *state;
        if (const auto* hello = std::get_if<wire::Hello>(&*message)) way.hello = *hello;
    }
    way.book.try_emplace(text_of(datagram), Entry{runs_[way.to], false});
    const std::uint64_t number = way.seen++;
    if (way.remembered.size() < remembered_max) {
        way.remembered.emplace_back(datagram.begin(), datagram.end());
        return;
    }
    const auto place = static_cast<std::size_t>(chance() * static_cast<double>(number));
    if (place < way.remembered.size())
        way.remembered[place].assign(datagram.begin(), datagram.end());
}

void Mallory::give(const Way& way, std::span<const std::byte> datagram, base::TimePoint arrived)
{
    give_from(way, datagram, lab::virtual_time::place_of(way.from), arrived);
}

void Mallory::give_from(const Way& way, std::span<const std::byte> datagram,
                        const secure::Place& from, base::TimePoint arrived)
{
    if (!world_.is_alive(way.to)) return;
    ++given_[way.to];
    lab::virtual_time::VirtualPlayer& victim = world_.side(way.to);
    peer::line::Line& line = victim.lines[way.line];
    const base::TimePoint at = arrived + victim.clock_ahead;
    const std::uint64_t taken = allocations();
    const auto message = line.open(datagram, from, at);
    if (allocations() != taken) breach_ = "opening a datagram takes memory";
    if (!message) return;
    ++let_in_[way.to];
    if (line.is_sealed()) audit(way_between(way.from, way.to), datagram);
    victim.side->on_datagram(*message, at, way.line);
}

/// What was let in must have come this way as it is, to this run, and once.
void Mallory::audit(std::size_t way, std::span<const std::byte> datagram)
{
    auto& book = ways_[way].book;
    const auto found = book.find(text_of(datagram));
    if (found == book.end()) {
        breach_ = "a message was accepted that the other side has not sealed";
        return;
    }
    if (found->second.is_accepted) breach_ = "a message was accepted twice";
    if (found->second.run != runs_[ways_[way].to])
        breach_ = "a message to an earlier run was accepted";
    found->second.is_accepted = true;
}

void Mallory::hold(const Way& way, std::span<const std::byte> datagram)
{
    held_.push_back({way_between(way.from, way.to), Bytes{datagram.begin(), datagram.end()},
                     world_.now() + up_to(habits_.held_for)});
}

void Mallory::act()
{
    if (!is_there_) return;
    // Not std::erase_if: what is given may be damaged or lost no more.
    for (std::size_t i = 0; i < held_.size();) {
        if (held_[i].due > world_.now()) {
            ++i;
            continue;
        }
        give(ways_[held_[i].way], held_[i].bytes, world_.now());
        std::swap(held_[i], held_.back());
        held_.pop_back();
    }
    for (Way& way : ways_) attack(way);
}

void Mallory::leave()
{
    is_there_ = false;
    held_.clear();
}

void Mallory::attack(Way& way)
{
    if (happens(habits_.silence)) way.silent_until = world_.now() + up_to(habits_.held_for);
    if (happens(habits_.replay)) replay(way, way);
    if (happens(habits_.reflect)) replay(way, another(way));
    if (happens(habits_.splice)) splice(way);
    if (happens(habits_.forge)) forge(way);
    if (happens(habits_.storm)) storm(way);
}

/// Of two sides the way back; of more any other one.
const Mallory::Way& Mallory::another(const Way& way)
{
    if (ways_.size() == 2) return ways_[way_between(way.to, way.from)];
    const std::size_t other = below(ways_.size() - 1);
    return ways_[other < way_between(way.from, way.to) ? other : other + 1];
}

/// A datagram that was on its way along `source`.
void Mallory::replay(const Way& way, const Way& source)
{
    const auto& kept = source.remembered;
    if (!kept.empty()) give(way, view(kept[below(kept.size())]), world_.now());
}

void Mallory::splice(const Way& way)
{
    const auto& kept = way.remembered;
    if (kept.size() < 2) return;
    Bytes bytes = kept[below(kept.size())];
    const Bytes& other = kept[below(kept.size())];
    const std::size_t from = below(std::min(bytes.size(), other.size()));
    bytes.resize(from);
    bytes.insert(bytes.end(), other.begin() + static_cast<std::ptrdiff_t>(from), other.end());
    give(way, bytes, world_.now());
}

void Mallory::forge(const Way& way)
{
    if (!world_.is_alive(way.to)) return;
    if (world_.side(way.to).lines[way.line].is_sealed() && happens(0.7)) return forge_sealed(way);
    forge_plain(way);
}

/// A message under a key that he has seen, with another number, and perhaps noise behind it.
void Mallory::forge_sealed(const Way& way)
{
    const auto& kept = way.remembered;
    if (kept.empty()) return;
    Bytes bytes = kept[below(kept.size())];
    if (bytes.size() <= clear_head) return;
    bytes[sequence_at] ^= static_cast<std::byte>(1 + below(255));
    if (happens(0.5)) bytes[sequence_at + 1] ^= static_cast<std::byte>(below(256));
    const bool is_noise = happens(0.5);
    for (std::size_t i = clear_head; is_noise && i < bytes.size(); ++i) {
        bytes[i] = static_cast<std::byte>(below(256));
    }
    give(way, bytes, world_.now());
}

void Mallory::forge_plain(const Way& way)
{
    const auto& session = world_.side(way.to).peer().others()[way.line].session();
    if (happens(0.1) && way.hello) {
        give(way, wire::encode(forged(*way.hello)).bytes(), world_.now());
    } else if (session && happens(0.02)) {
        constexpr std::array reasons{wire::ByeReason::finished, wire::ByeReason::interrupted,
                                     wire::ByeReason::other_scene};
        const wire::Bye bye{session->number, reasons.at(below(reasons.size()))};
        give(way, wire::encode(bye).bytes(), world_.now());
    } else if (way.state) {
        give(way, wire::encode(forged(*way.state)).bytes(), world_.now());
    } else if (session) { // behind a seal he sees no state: he makes one up
        wire::State state;
        state.session = session->number;
        state.sequence = 1 + static_cast<std::uint32_t>(below(10'000));
        state.sent = world_.now();
        give(way, wire::encode(forged(state)).bytes(), world_.now());
    }
}

wire::State Mallory::forged(wire::State state)
{
    const auto place = [this] {
        return base::Position{{0.4 * chance() - 0.2, 0.1 * chance() - 0.05, 0.0}};
    };
    const auto velocity = [this] { return base::Velocity{{4.0 * chance() - 2.0, 0.0, 0.0}}; };
    state.sequence += static_cast<std::uint32_t>(below(happens(0.2) ? 2000 : 3));
    state.sent += happens(0.3) ? up_to(1s) : 1ms;
    state.touching = happens(0.8);
    state.holding = state.touching && happens(0.3);
    state.contact_force = {{20.0 * chance() - 10.0, 0.0, 0.0}};
    if (happens(0.5)) state.hip = place();
    if (happens(0.5)) state.hip_velocity = velocity();
    if (state.echo && happens(0.3)) state.echo->of -= up_to(1s);
    wire::BodyStates bodies;
    for (wire::BodyState body : state.bodies) {
        body.position = place();
        body.velocity = velocity();
        body.caused_impulse_uns[0] += static_cast<std::uint32_t>(below(2'000'000)) - 1'000'000U;
        bodies.add(body);
    }
    state.bodies = bodies;
    return state;
}

wire::Hello Mallory::forged(wire::Hello hello)
{
    switch (below(6)) {
    case 0: hello.start = hello.sent + up_to(4s) - 2s; break;
    case 1: hello.nonce += static_cast<std::uint32_t>(1 + below(1000)); break;
    case 2: hello.scene_hash ^= 1U; break;
    case 3: hello.in_session = !hello.in_session; break;
    case 4: hello.nonce_heard += 1; break;
    default: hello.length_ms = static_cast<std::uint32_t>(1 + below(20'000)); break;
    }
    if (hello.nonce_heard == 0) hello.start_heard.reset();
    return hello;
}

void Mallory::storm(const Way& way)
{
    constexpr int burst = 200;
    for (int i = 0; i < burst; ++i) {
        if (way.hello && i % 2 == 0) {
            wire::Hello hello = *way.hello;
            hello.nonce += static_cast<std::uint32_t>(1 + below(1'000'000));
            give(way, wire::encode(hello).bytes(), world_.now());
            continue;
        }
        const auto& kept = way.remembered;
        if (kept.empty()) return;
        Bytes bytes = kept[below(kept.size())]; // a true handshake, or a true head and noise
        const bool is_handshake = bytes.size() == secure::initiation_bytes &&
                                  secure::frame_type_of(bytes) == secure::FrameType::initiation;
        for (std::size_t at = 4; !is_handshake && at < bytes.size(); ++at) {
            bytes[at] = static_cast<std::byte>(below(256));
        }
        if (!is_handshake && bytes.size() > 3) bytes[3] = static_cast<std::byte>(0x80 + below(16));
        give(way, bytes, world_.now());
    }
}

void Mallory::damage(Bytes& bytes)
{
    for (std::size_t left = 1 + below(8); left > 0; --left) {
        bytes[below(bytes.size())] ^= static_cast<std::byte>(1U << below(8));
    }
}

} // namespace hapnet::test
