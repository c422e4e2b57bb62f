// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/impairment.hpp"
#include "emulator/core/pipeline.hpp"
#include "proto/base/probability.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::emulator {

/// Up: from A to B. Down: from B to A.
enum class Direction : std::uint8_t { up, down };
[[nodiscard]] std::string_view to_text(Direction direction);

/// Whether jitter may reorder.
enum class Order : std::uint8_t {
    keep, // no datagram leaves before one that arrived earlier; wide jitter lengthens the mean
    free, // each datagram leaves at its own time
};
[[nodiscard]] std::string_view to_text(Order order);
/// "keep" or "free".
[[nodiscard]] base::Result<Order> parse_order(std::string_view text);

/// "40/100": 40 in a row of every 100. A bare "0" is no burst loss.
[[nodiscard]] base::Result<std::optional<Burst>> parse_burst(std::string_view text);
[[nodiscard]] std::string to_text(const Burst& burst);

/// What one direction is to do to its datagrams. The defaults do nothing.
struct Conditions {
    base::Probability loss{};
    std::optional<Burst> burst_loss{};
    base::Duration delay{};
    base::Duration jitter{}; // half width of a uniform law
    Order order = Order::keep;

    friend bool operator==(const Conditions&, const Conditions&) = default;
};

/// The conditions as a pipeline, always in this order: random loss, burst loss, delay, jitter.
/// A stage that does nothing is left out. Stage S of direction D draws from the stream
/// "D/S" of the seed ("up/random-loss", "down/jitter", ...), and from no other: neither other
/// stages nor the other direction can shift its draws.
[[nodiscard]] Pipeline pipeline_of(const Conditions& conditions, base::Seed seed,
                                   Direction direction);

} // namespace hapnet::emulator
