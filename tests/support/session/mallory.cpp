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
    : world_{world}, habits_{habits}, draw_{seed.stream("mallory")}
{
    world_.intercept([this](const lab::virtual_time::VirtualWorld::Arrival& arrival) {
        on_arrival(arrival.to, arrival.datagram, arrival.at);
    });
}

void Mallory::on_arrival(std::size_t to, std::span<const std::byte> datagram,
                         base::TimePoint arrived)
{
    remember(to, datagram);
    if (is_there_ && happens(habits_.redirect)) {
        return give_from(to, datagram, secure::Place{std::byte{0xee}}, arrived);
    }
    if (!is_there_) return give(to, datagram, arrived);
    if (arrived < silent_until_.at(to) || happens(habits_.drop)) return;
    if (happens(habits_.copy)) hold(to, datagram);
    if (happens(habits_.hold)) return hold(to, datagram);
    const bool flips = happens(habits_.flip);
    const bool resizes = happens(habits_.resize);
    if (!flips && !resizes) return give(to, datagram, arrived);
    Bytes bytes{datagram.begin(), datagram.end()};
    if (flips) damage(bytes);
    if (resizes) bytes.resize(below(bytes.size() + 20));
    give(to, bytes, arrived);
}

/// Keeps an even choice of all that ever went to this side (reservoir sampling, J. S. Vitter 1985).
void Mallory::remember(std::size_t to, std::span<const std::byte> datagram)
{
    if (const auto message = wire::decode(datagram)) {
        if (const auto* state = std::get_if<wire::State>(&*message)) state_.at(to) = *state;
        if (const auto* hello = std::get_if<wire::Hello>(&*message)) hello_.at(to) = *hello;
    }
    book_.at(to).try_emplace(text_of(datagram), Entry{runs_.at(to), false});
    auto& kept = remembered_.at(to);
    const std::uint64_t number = seen_.at(to)++;
    if (kept.size() < remembered_max) {
        kept.emplace_back(datagram.begin(), datagram.end());
        return;
    }
    const auto place = static_cast<std::size_t>(chance() * static_cast<double>(number));
    if (place < kept.size()) kept[place].assign(datagram.begin(), datagram.end());
}

void Mallory::give(std::size_t to, std::span<const std::byte> datagram, base::TimePoint arrived)
{
    give_from(to, datagram, lab::virtual_time::place_of(1 - to), arrived);
}

void Mallory::give_from(std::size_t to, std::span<const std::byte> datagram,
                        const secure::Place& from, base::TimePoint arrived)
{
    if (!world_.is_alive(to)) return;
    ++given_.at(to);
    lab::virtual_time::VirtualPlayer& victim = world_.side(to);
    const base::TimePoint at = arrived + victim.clock_ahead;
    const std::uint64_t taken = allocations();
    const auto message = victim.lines[0].open(datagram, from, at);
    if (allocations() != taken) breach_ = "opening a datagram takes memory";
    if (!message) return;
    ++let_in_.at(to);
    if (victim.lines[0].is_sealed()) audit(to, datagram);
    victim.side->on_datagram(*message, at);
}

/// What was let in must have come over the path as it is, in this run, and once.
void Mallory::audit(std::size_t to, std::span<const std::byte> datagram)
{
    const auto found = book_.at(to).find(text_of(datagram));
    if (found == book_.at(to).end()) {
        breach_ = "a message was accepted that the other side has not sealed";
        return;
    }
    if (found->second.is_accepted) breach_ = "a message was accepted twice";
    if (found->second.run != runs_.at(to)) breach_ = "a message to an earlier run was accepted";
    found->second.is_accepted = true;
}

void Mallory::hold(std::size_t to, std::span<const std::byte> datagram)
{
    held_.push_back(
        {to, Bytes{datagram.begin(), datagram.end()}, world_.now() + up_to(habits_.held_for)});
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
        give(held_[i].to, held_[i].bytes, world_.now());
        std::swap(held_[i], held_.back());
        held_.pop_back();
    }
    for (const std::size_t to : {0U, 1U}) attack(to);
}

void Mallory::leave()
{
    is_there_ = false;
    held_.clear();
}

void Mallory::attack(std::size_t to)
{
    if (happens(habits_.silence)) silent_until_.at(to) = world_.now() + up_to(habits_.held_for);
    if (happens(habits_.replay)) replay(to, to);
    if (happens(habits_.reflect)) replay(to, 1 - to);
    if (happens(habits_.splice)) splice(to);
    if (happens(habits_.forge)) forge(to);
    if (happens(habits_.storm)) storm(to);
}

/// A datagram that was on its way to `sent_to`.
void Mallory::replay(std::size_t to, std::size_t sent_to)
{
    const auto& kept = remembered_.at(sent_to);
    if (!kept.empty()) give(to, view(kept[below(kept.size())]), world_.now());
}

void Mallory::splice(std::size_t to)
{
    const auto& kept = remembered_.at(to);
    if (kept.size() < 2) return;
    Bytes bytes = kept[below(kept.size())];
    const Bytes& other = kept[below(kept.size())];
    const std::size_t from = below(std::min(bytes.size(), other.size()));
    bytes.resize(from);
    bytes.insert(bytes.end(), other.begin() + static_cast<std::ptrdiff_t>(from), other.end());
    give(to, bytes, world_.now());
}

void Mallory::forge(std::size_t to)
{
    if (!world_.is_alive(to)) return;
    if (world_.side(to).lines[0].is_sealed() && happens(0.7)) return forge_sealed(to);
    forge_plain(to);
}

/// A message under a key that he has seen, with another number, and perhaps noise behind it.
void Mallory::forge_sealed(std::size_t to)
{
    const auto& kept = remembered_.at(to);
    if (kept.empty()) return;
    Bytes bytes = kept[below(kept.size())];
    if (bytes.size() <= clear_head) return;
    bytes[sequence_at] ^= static_cast<std::byte>(1 + below(255));
    if (happens(0.5)) bytes[sequence_at + 1] ^= static_cast<std::byte>(below(256));
    const bool is_noise = happens(0.5);
    for (std::size_t i = clear_head; is_noise && i < bytes.size(); ++i) {
        bytes[i] = static_cast<std::byte>(below(256));
    }
    give(to, bytes, world_.now());
}

void Mallory::forge_plain(std::size_t to)
{
    const auto& session = world_.side(to).peer().session();
    if (happens(0.1) && hello_.at(to)) {
        give(to, wire::encode(forged(*hello_.at(to))).bytes(), world_.now());
    } else if (session && happens(0.02)) {
        constexpr std::array reasons{wire::ByeReason::finished, wire::ByeReason::interrupted,
                                     wire::ByeReason::other_scene};
        const wire::Bye bye{session->number, reasons.at(below(reasons.size()))};
        give(to, wire::encode(bye).bytes(), world_.now());
    } else if (state_.at(to)) {
        give(to, wire::encode(forged(*state_.at(to))).bytes(), world_.now());
    } else if (session) { // behind a seal he sees no state: he makes one up
        wire::State state;
        state.session = session->number;
        state.sequence = 1 + static_cast<std::uint32_t>(below(10'000));
        state.sent = world_.now();
        give(to, wire::encode(forged(state)).bytes(), world_.now());
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

void Mallory::storm(std::size_t to)
{
    constexpr int burst = 200;
    for (int i = 0; i < burst; ++i) {
        if (hello_.at(to) && i % 2 == 0) {
            wire::Hello hello = *hello_.at(to);
            hello.nonce += static_cast<std::uint32_t>(1 + below(1'000'000));
            give(to, wire::encode(hello).bytes(), world_.now());
            continue;
        }
        const auto& kept = remembered_.at(to);
        if (kept.empty()) return;
        Bytes bytes = kept[below(kept.size())]; // a true handshake, or a true head and noise
        const bool is_handshake = bytes.size() == secure::initiation_bytes &&
                                  secure::frame_type_of(bytes) == secure::FrameType::initiation;
        for (std::size_t at = 4; !is_handshake && at < bytes.size(); ++at) {
            bytes[at] = static_cast<std::byte>(below(256));
        }
        if (!is_handshake && bytes.size() > 3) bytes[3] = static_cast<std::byte>(0x80 + below(16));
        give(to, bytes, world_.now());
    }
}

void Mallory::damage(Bytes& bytes)
{
    for (std::size_t left = 1 + below(8); left > 0; --left) {
        bytes[below(bytes.size())] ^= static_cast<std::byte>(1U << below(8));
    }
}

} // namespace hapnet::test
