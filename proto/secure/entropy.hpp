// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/secure/primitives.hpp"

#include <array>
#include <cstdint>

namespace hapnet::secure {

/// Derives secrets from one that was drawn at random, because a core draws nothing itself and tests
/// must be repeatable. After each draw the state is hashed forward, so that memory read later does
/// not reveal earlier draws.
class Entropy {
public:
    explicit Entropy(Secret seed) : state_{std::move(seed)} {}

    [[nodiscard]] Secret secret()
    {
        const SecretHash next = authenticate(state_.bytes(), purpose_state);
        Secret drawn{authenticate(state_.bytes(), purpose_draw).bytes().first<key_bytes>()};
        state_ = Secret{next.bytes().first<key_bytes>()};
        return drawn;
    }
    /// Returns random bytes for public use, such as an index or a nonce.
    template <std::size_t count>
    [[nodiscard]] std::array<std::byte, count> bytes()
    {
        static_assert(count <= key_bytes);
        const Secret drawn = secret();
        std::array<std::byte, count> result{};
        for (std::size_t i = 0; i < count; ++i) result[i] = drawn.bytes()[i];
        return result;
    }

private:
    static constexpr std::array purpose_state{std::byte{1}};
    static constexpr std::array purpose_draw{std::byte{2}};

    Secret state_;
};

} // namespace hapnet::secure
