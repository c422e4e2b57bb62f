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
        hello.peer_id = static_cast<std::uint16_t>(bits());
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
        if (coin()) state.body = body();
        return state;
    }

    [[nodiscard]] BodyState body()
    {
        BodyState body;
        body.body = static_cast<std::uint16_t>(bits());
        body.position = {vector()};
        body.velocity = {vector()};
        for (auto& sum : body.caused_displacement_nm) sum = std::bit_cast<std::int64_t>(bits());
        for (auto& sum : body.caused_impulse_nns) sum = std::bit_cast<std::int64_t>(bits());
        return body;
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
