// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/bytes.hpp"
#include "proto/base/random.hpp"
#include "proto/secure/association.hpp"
#include "tests/unit/proto/secure/hex.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace hapnet::secure::circle {

// Two associations and the datagrams between them, in steps of a millisecond.

using namespace std::chrono_literals;

[[nodiscard]] inline Secret secret_of(std::uint8_t number)
{
    Secret secret;
    std::ranges::fill(secret.bytes(), std::byte{number});
    return secret;
}

[[nodiscard]] inline Place place_of(std::uint8_t number)
{
    Place place{};
    place[0] = std::byte{number};
    return place;
}

[[nodiscard]] inline std::uint32_t session_of(std::uint32_t low, std::uint32_t high)
{
    return low * 1000 + high;
}

/// A plain state: magic, version, type, session, sequence, time; then a body.
[[nodiscard]] inline Text state(std::uint32_t session, std::uint32_t sequence)
{
    Text text(70);
    base::ByteWriter out{text};
    out.u16(magic);
    out.u8(version);
    out.u8(2);
    out.u32(session);
    out.u32(sequence);
    out.i64(sequence * 1'000'000LL);
    return text;
}
[[nodiscard]] inline Text hello(std::uint8_t content = 0)
{
    Text text(101, std::byte{content});
    base::ByteWriter out{text};
    out.u16(magic);
    out.u8(version);
    out.u8(1);
    out.u32(0);
    return text;
}

struct Setting {
    std::uint8_t id = 1;
    std::uint32_t run = 11;
    std::uint8_t shared = 9;       // names the pre-shared key; 0: none
    std::uint8_t other_key_of = 0; // the id whose public key it expects; 0: the other id
    bool may_roam = true;
    bool knows_place = true;
    std::uint8_t seed = 100;
};

[[nodiscard]] inline std::unique_ptr<Association> association(const Setting& setting)
{
    const auto other = static_cast<std::uint8_t>(3 - setting.id);
    const std::uint8_t expected = setting.other_key_of == 0 ? other : setting.other_key_of;
    auto keys = StaticKeys::from(secret_of(setting.id), public_key_of(secret_of(expected)),
                                 secret_of(setting.shared));
    Association::Config config;
    config.own_id = setting.id;
    config.other_id = other;
    config.run = setting.run;
    config.may_roam = setting.may_roam;
    config.session_of = session_of;
    if (setting.knows_place) config.place = place_of(other);
    return std::make_unique<Association>(config, std::move(*keys), secret_of(setting.seed));
}

/// One side, its messages, and what it has received.
struct Side {
    std::unique_ptr<Association> association;
    Place place{};
    std::uint32_t run = 0;
    std::int64_t unix_offset_ns = 0;
    bool talks = true;
    std::uint32_t sequence = 0;
    std::uint32_t session = 0;           // learned from the other run, as from a hello
    std::vector<std::uint32_t> received; // sequences
    std::uint64_t hellos = 0;
};

struct Datagram {
    Text bytes;
    Place from{};
    int to = 0; // 0, 1
    base::TimePoint at;
};

struct Network {
    double loss = 0.0;
    base::Duration delay{5ms};
    base::Duration jitter{0};
    double duplicates = 0.0;
    std::uint64_t seed = 1;
    std::optional<Place> redirected_from{};          // source of all datagrams, whoever sent them
    std::function<bool(const Datagram&)> drops = {}; // in addition to random loss
};

class World {
public:
    World(const Setting& a, const Setting& b, const Network& network = {})
        : network_{network}, random_{base::Seed{network.seed}.stream("network")}
    {
        sides_[0] = side(a);
        sides_[1] = side(b);
    }

    [[nodiscard]] static Side side(const Setting& setting)
    {
        Side side;
        side.association = association(setting);
        side.place = place_of(setting.id);
        side.run = setting.run;
        return side;
    }

    Side& a() { return sides_[0]; }
    Side& b() { return sides_[1]; }
    Network& network() { return network_; }
    [[nodiscard]] base::TimePoint now() const { return now_; }
    std::vector<Datagram>& seen() { return seen_; } // everything that was ever sent

    void run(base::Duration time)
    {
        for (const base::TimePoint end = now_ + time; now_ < end; now_ += 1ms) step();
    }
    /// Lets time pass without any event.
    void skip(base::Duration time) { now_ += time; }
    /// Gives it to a side at once.
    void give(int to, Text bytes, const Place& from)
    {
        deliver({std::move(bytes), from, to, now_});
    }
    [[nodiscard]] Moment moment(const Side& side) const
    {
        return {now_, now_.time_since_epoch().count() + side.unix_offset_ns};
    }

private:
    void step()
    {
        std::vector<Datagram> due;
        for (auto it = under_way_.begin(); it != under_way_.end() && it->first <= now_;)
            due.push_back(std::move(it->second)), it = under_way_.erase(it);
        for (Datagram& each : due) deliver(std::move(each));
        for (const int i : {0, 1}) {
            Side& side = sides_[static_cast<std::size_t>(i)];
            if (!side.association) continue;
            side.association->tick(moment(side));
            if (side.talks) talk(i, side);
            while (const auto out = side.association->poll())
                send(i, Text{out->frame.bytes().begin(), out->frame.bytes().end()}, out->to);
        }
    }

    void talk(int i, Side& side)
    {
        // A hello every 20 ms, and states as soon as the session is known.
        if (now_.time_since_epoch() % 20ms == 0ms) seal_and_send(i, side, hello());
        if (side.session != 0) seal_and_send(i, side, state(side.session, ++side.sequence));
    }

    void seal_and_send(int i, Side& side, Text message)
    {
        const std::size_t size = message.size();
        message.resize(size + control_overhead);
        const auto sealed = side.association->seal(message, size, now_);
        if (!sealed) return;
        message.resize(*sealed);
        send(i, std::move(message), *side.association->place());
    }

    void send(int from, Text bytes, const Place& to)
    {
        const Side& sender = sides_[static_cast<std::size_t>(from)];
        Datagram datagram{std::move(bytes), sender.place, 1 - from, now_};
        seen_.push_back(datagram);
        if (sides_[static_cast<std::size_t>(1 - from)].place != to) return; // no side is there
        if (network_.drops && network_.drops(datagram)) return;
        datagram.from = network_.redirected_from.value_or(datagram.from);
        ++count_;
        const bool is_doubled = random_.uniform(count_, 0) < network_.duplicates;
        for (const std::uint32_t copy : {1U, 2U}) {
            if (copy == 2 && !is_doubled) break;
            if (random_.uniform(count_, 10 * copy) < network_.loss) continue;
            const auto jitter = std::chrono::duration_cast<base::Duration>(
                network_.jitter * random_.uniform(count_, 10 * copy + 1));
            datagram.at = now_ + network_.delay + jitter;
            under_way_.emplace(datagram.at, datagram);
        }
    }

    void deliver(Datagram datagram)
    {
        Side& side = sides_[static_cast<std::size_t>(datagram.to)];
        if (!side.association) return;
        const auto received = side.association->on_datagram(datagram.bytes, datagram.from, now_);
        if (!received) return;
        base::ByteReader in{Bytes{datagram.bytes}.subspan(3)};
        const auto type = in.u8();
        const std::uint32_t session = in.u32();
        if (type == 1) ++side.hellos;
        if (type == 2 && session == side.session) side.received.push_back(in.u32());
        if (type == 1) {
            const std::uint32_t agreed = datagram.to == 0
                                             ? session_of(side.run, received->other_run)
                                             : session_of(received->other_run, side.run);
            if (agreed == side.session) return;
            side.session = agreed;
            side.sequence = 0;
            side.received.clear();
        }
    }

    Network network_;
    base::RandomStream random_;
    std::uint64_t count_ = 0;
    std::array<Side, 2> sides_;
    base::TimePoint now_;
    std::multimap<base::TimePoint, Datagram> under_way_;
    std::vector<Datagram> seen_;
};

} // namespace hapnet::secure::circle
