// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace hapnet::base {

/// A random stream whose n-th draw is a pure function of (seed, name, n): it has no state, so
/// drawing from one stream never shifts another, and a draw can be repeated at any time.
/// Philox-4x32-10 (Salmon et al., SC 2011) keyed by the seed and a hash of the name.
class RandomStream {
public:
    /// 64 uniform bits. `index` is usually the number of a datagram; `draw` tells several draws
    /// for the same index apart.
    [[nodiscard]] std::uint64_t bits(std::uint64_t index, std::uint32_t draw = 0) const;

    /// Uniform on [0, 1), in steps of 2^-53.
    [[nodiscard]] double uniform(std::uint64_t index, std::uint32_t draw = 0) const;

    /// Uniform on 0, 1, ... below-1 without modulo bias worth speaking of (below < 2^32).
    [[nodiscard]] std::uint64_t below(std::uint32_t below, std::uint64_t index,
                                      std::uint32_t draw = 0) const;

private:
    friend class Seed;
    RandomStream(std::uint64_t key, std::uint32_t domain) : key_{key}, domain_{domain} {}

    std::uint64_t key_;
    std::uint32_t domain_;
};

/// The one number that all chance of a run comes from. Printed in every result.
class Seed {
public:
    explicit constexpr Seed(std::uint64_t value = 0) : value_{value} {}

    [[nodiscard]] constexpr std::uint64_t value() const { return value_; }

    /// The stream of this name, e.g. "up/loss". Different names give independent streams.
    [[nodiscard]] RandomStream stream(std::string_view name) const;

    friend constexpr bool operator==(Seed, Seed) = default;

private:
    std::uint64_t value_;
};

} // namespace hapnet::base
