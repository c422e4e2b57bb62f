// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/law.hpp"
#include "emulator/core/loss/law.hpp"
#include "emulator/core/verdict.hpp"
#include "proto/base/probability.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace hapnet::emulator {

/// Up: from A to B. Down: from B to A.
enum class Direction : std::uint8_t { up, down };
[[nodiscard]] std::string_view to_text(Direction direction);

/// In which order datagrams leave that jitter would let overtake each other.
enum class Order : std::uint8_t {
    keep,   // none leaves before one that arrived earlier: wide jitter lengthens the mean
    free,   // each leaves at its own time: wide jitter reorders
    sorted, // the times are drawn as for free, and the datagrams take them in order of arrival
};
[[nodiscard]] std::string_view to_text(Order order);

/// A second copy of a share of the datagrams, up to `spread` after the original (uniform). A copy
/// is not lost, copied or corrupted on its own.
struct Duplication {
    base::Probability share{};
    base::Duration spread{};

    friend bool operator==(const Duplication&, const Duplication&) = default;
};

/// A share of the datagrams leaves behind its turn, whatever the order policy is.
struct Reordering {
    base::Probability share{};
    Displacement displacement{};

    friend bool operator==(const Reordering&, const Reordering&) = default;
};

/// `bits` bits of a share of the datagrams are inverted; 1 <= bits <= Flips::most.
struct Corruption {
    base::Probability share{};
    std::uint8_t bits = 1;

    friend bool operator==(const Corruption&, const Corruption&) = default;
};

/// Datagrams larger than `bytes_max` with their IP and UDP headers are dropped; 0: no limit.
struct Mtu {
    static constexpr std::size_t header_bytes = 28; // IPv4 and UDP

    std::size_t bytes_max = 0;

    friend bool operator==(const Mtu&, const Mtu&) = default;
};

/// A bottleneck that sends so many bits a second, one datagram after the other, from a queue that
/// drops what does not fit (drop-tail). 0 bits: no bottleneck.
struct Rate {
    std::uint64_t bits_per_second = 0;
    std::size_t overhead_bytes = 28;        // added to each payload: IPv4 and UDP
    std::size_t queue_bytes_max = 64 << 10; // waiting, with overhead, besides the one being sent

    friend bool operator==(const Rate&, const Rate&) = default;
};

/// What one direction does to its datagrams. The defaults do nothing.
struct Conditions {
    Mtu mtu{};
    Rate rate{};
    std::vector<LossLaw> loss{}; // at most loss_laws_max; a datagram that any of them takes is lost
    Corruption corrupt{};
    Duplication duplicate{};
    Variation delay{};
    Variation jitter{};
    Order order = Order::keep;
    Reordering reorder{};

    friend bool operator==(const Conditions&, const Conditions&) = default;
};

/// What a change sets; the rest stays as it is.
struct Patch {
    std::optional<Mtu> mtu{};
    std::optional<Rate> rate{};
    std::optional<std::vector<LossLaw>> loss{};
    std::optional<Corruption> corrupt{};
    std::optional<Duplication> duplicate{};
    std::optional<Variation> delay{};
    std::optional<Variation> jitter{};
    std::optional<Order> order{};
    std::optional<Reordering> reorder{};

    friend bool operator==(const Patch&, const Patch&) = default;
};

/// The conditions with what `patch` sets.
[[nodiscard]] Conditions patched(Conditions conditions, const Patch& patch);

/// Both ways of a path.
struct Path {
    Conditions up;
    Conditions down;

    friend bool operator==(const Path&, const Path&) = default;
};

} // namespace hapnet::emulator
