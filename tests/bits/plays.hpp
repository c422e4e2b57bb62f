// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace hapnet::bits {

/// A built-in scene and what two hands do in it: circles of different sizes and periods that
/// push, graze, squeeze and leave, and a teleport now and then.
struct Play {
    std::string_view scene;
    bool sleeping = true;
};

[[nodiscard]] std::span<const Play> plays();

/// Returns the state's hash after this number of ticks of 1 ms.
[[nodiscard]] std::uint64_t hash_after(const Play& play, std::uint64_t ticks);

/// As hash_after(), but every `every` ticks a snapshot carries the state over into another world.
[[nodiscard]] std::uint64_t hash_over_snapshots(const Play& play, std::uint64_t ticks,
                                                std::uint64_t every);

} // namespace hapnet::bits
