// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace hapnet::base {

/// A random stream whose n-th draw is a pure function of (seed, name, n). As it has no state,
/// drawing from one stream never affects another, and a draw can be repeated at any time. It is
/// Philox-4x32-10 (Salmon et al., SC 2011), keyed by the seed and a hash of the name.
class RandomStream {
public:
    /// Returns 64 uniform bits. `index` is usually the number of a datagram; `draw` distinguishes
    /// several draws for the same index.
    [[nodiscard]] std::uint64_t bits(std::uint64_t index, std::uint32_t draw = 0) const;

    /// Returns a number that is uniform on [0, 1), in steps of 2^-53.
    [[nodiscard]] double uniform(std::uint64_t index, std::uint32_t draw = 0) const;

    /// Returns a number that is uniform on 0, 1, ... below-1 (below < 2^32). The modulo bias is
    /// negligible.
    [[nodiscard]] std::uint64_t below(std::uint32_t below, std::uint64_t index,
                                      std::uint32_t draw = 0) const;

private:
    friend class Seed;
    RandomStream(std::uint64_t key, std::uint32_t domain) : key_{key}, domain_{domain} {}

    std::uint64_t key_;
    std::uint32_t domain_;
};

/// The number that all randomness of a run is derived from. Every result contains it.
class Seed {
public:
    explicit constexpr Seed(std::uint64_t value = 0) : value_{value} {}

    [[nodiscard]] constexpr std::uint64_t value() const { return value_; }

    /// Returns the stream with this name, e.g. "up/loss". Different names give independent streams.
    [[nodiscard]] RandomStream stream(std::string_view name) const;

    friend constexpr bool operator==(Seed, Seed) = default;

private:
    std::uint64_t value_;
};

} // namespace hapnet::base
