// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"
#include "proto/wire/message.hpp"

#include <bit>
#include <cmath>

namespace hapnet::wire {

/// Messages with whatever bits their fields may hold, one for each round.
class RandomMessage {
public:
    RandomMessage(base::RandomStream stream, std::uint64_t round) : stream_{stream}, round_{round}
    {}

    [[nodiscard]] Message message()
    {
        switch (below(3)) {
        case 0: return hello();
        case 1: return state();
        default: return Bye{u32(), static_cast<ByeReason>(below(bye_reasons))};
        }
    }

private:
    [[nodiscard]] Hello hello()
    {
        Hello hello;
        hello.nonce = u32() | 1U;
        hello.nonce_heard = u32();
        hello.peer_id = static_cast<std::uint16_t>(bits() | 1U);
        hello.tick_rate_hz = static_cast<std::uint16_t>(bits());
        hello.scene_hash = bits();
        hello.seed = bits();
        hello.sent = time();
        hello.echo = echo();
        if (coin()) hello.start = time();
        if (coin()) hello.start_heard = time();
        hello.in_session = coin();
        std::string name(1 + below(TaskName::bytes_max), ' ');
        for (char& c : name) c = static_cast<char>('!' + below('~' - '!' + 1));
        hello.task = TaskName::from_text(name).value();
        hello.length_ms = u32();
        hello.heard = u32() & ~1U;
        hello.boot = u32();
        hello.hand = {size(), size(), size(), size()};
        return hello;
    }

    [[nodiscard]] State state()
    {
        State state;
        state.session = u32();
        state.sequence = u32() | 1U;
        state.sent = time();
        state.echo = echo();
        state.touching = coin();
        state.holding = state.touching && coin();
        state.hip = {vector()};
        state.hip_velocity = {vector()};
        state.contact_force = {vector()};
        state.intention = {1e-5 * steps()};
        state.intention_velocity = {2e-4 * steps()};
        state.work_uj = u32();
        std::uint32_t id = 0;
        for (auto left = coin() ? below(bodies_max + 1) : 0; left > 0; --left) {
            id += 1 + static_cast<std::uint32_t>(below(4000));
            state.bodies.add(body(static_cast<std::uint16_t>(id - 1)));
        }
        return state;
    }

    [[nodiscard]] BodyState body(std::uint16_t id)
    {
        BodyState body;
        body.body = id;
        body.position = {vector()};
        body.velocity = {vector()};
        body.caused_displacement_um = {u32(), u32(), u32()};
        body.caused_impulse_uns = {u32(), u32(), u32()};
        if (coin()) return body;
        Turning& turning = body.turning.emplace();
        const auto component = [this] { return stream_.uniform(round_, draw_++) - 0.5; };
        turning.orientation = Orientation::from(
            glm::normalize(glm::dquat{component(), component(), component(), component()}));
        turning.angular_velocity = vector();
        turning.caused_rotation_urad = {u32(), u32(), u32()};
        turning.caused_angular_impulse_unms = {u32(), u32(), u32()};
        return body;
    }

    [[nodiscard]] float size() { return static_cast<float>(below(1000)) / 8.0F; }
    /// An intention in the steps of its encoding.
    [[nodiscard]] glm::dvec3 steps()
    {
        const auto one = [this] { return static_cast<double>(below(0xffff)) - 0x7fff; };
        const double x = one(), y = one(), z = one();
        return {x, y, z};
    }

    [[nodiscard]] std::optional<Echo> echo()
    {
        if (coin()) return std::nullopt;
        return Echo{time(), base::Duration{u32()}};
    }

    /// Any three finite single-precision numbers, subnormal ones and both zeros included.
    [[nodiscard]] glm::dvec3 vector()
    {
        glm::dvec3 v;
        for (glm::length_t i = 0; i < 3; ++i) {
            const auto value = std::bit_cast<float>(u32());
            v[i] = std::isfinite(value) ? value : 0.0F;
        }
        return v;
    }

    /// Within 2^60 ns of zero.
    [[nodiscard]] base::TimePoint time()
    {
        return base::TimePoint{base::Duration{std::bit_cast<std::int64_t>(bits()) >> 3}};
    }
    [[nodiscard]] bool coin() { return (bits() & 1U) != 0; }
    [[nodiscard]] std::uint64_t below(std::uint32_t n) { return stream_.below(n, round_, draw_++); }
    [[nodiscard]] std::uint32_t u32() { return static_cast<std::uint32_t>(bits()); }
    [[nodiscard]] std::uint64_t bits() { return stream_.bits(round_, draw_++); }

    base::RandomStream stream_;
    std::uint64_t round_;
    std::uint32_t draw_ = 0;
};

} // namespace hapnet::wire
