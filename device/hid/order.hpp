// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace hapnet::device::hid {

/// What the motors are to do, and what else is wanted, in one word: so that a thread can leave it
/// for another without a lock, and the newest one counts.
struct Order {
    static constexpr double level_full = 32767.0;

    std::array<std::int16_t, 2> levels{}; // of full scale in 1/32767; right, away
    bool motors_on = false;
    bool is_last = false;    // give the effects' places back, too
    std::uint8_t stops = 0;  // counts the demands to stop, each of which is said anew
    std::uint8_t probes = 0; // counts the wishes to hear whether a resting device lives
    std::uint8_t number = 0; // counts the orders with the motors on

    friend bool operator==(const Order&, const Order&) = default;
};

[[nodiscard]] constexpr std::uint64_t packed(const Order& order)
{
    const auto at = [](std::uint64_t value, unsigned shift) { return value << shift; };
    return at(static_cast<std::uint16_t>(order.levels[0]), 0) |
           at(static_cast<std::uint16_t>(order.levels[1]), 16) | at(order.motors_on ? 1U : 0U, 32) |
           at(order.is_last ? 1U : 0U, 33) | at(order.stops, 40) | at(order.probes, 48) |
           at(order.number, 56);
}

[[nodiscard]] constexpr Order unpacked_order(std::uint64_t word)
{
    const auto byte = [&](unsigned shift) { return static_cast<std::uint8_t>(word >> shift); };
    const auto level = [&](unsigned shift) {
        return static_cast<std::int16_t>(static_cast<std::uint16_t>(word >> shift));
    };
    return {.levels = {level(0), level(16)},
            .motors_on = (byte(32) & 1U) != 0,
            .is_last = (byte(32) & 2U) != 0,
            .stops = byte(40),
            .probes = byte(48),
            .number = byte(56)};
}

} // namespace hapnet::device::hid
