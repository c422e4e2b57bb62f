// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/recent_numbers.hpp"
#include "proto/secure/primitives.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hapnet::secure {

/// The kind of a message. Each kind has its own numbers, so that a lost hello leaves no gap among
/// states.
enum class Kind : std::uint8_t { state = 0, control = 1 };
inline constexpr std::size_t kinds = 2;

/// Seals messages with one key. Ensures that the numbers of each kind increase, so that no nonce is
/// used twice.
class Sealer {
public:
    /// The largest number of a message of each kind that a key may seal.
    static constexpr std::uint32_t number_max = 0x7fff'ffff;

    explicit Sealer(Secret key) : key_{std::move(key)} {}

    [[nodiscard]] bool may_seal(Kind kind, std::uint32_t number) const
    {
        return number >= next_[static_cast<std::size_t>(kind)] && number <= number_max;
    }

    /// Seals a message. `room` contains the text and after it `tag_bytes` free bytes.
    void seal(Kind kind, std::uint32_t number, Bytes associated, std::span<std::byte> room);

private:
    Secret key_;
    std::array<std::uint64_t, kinds> next_{}; // smallest number that may be sealed next
};

/// Opens the messages that the other side's Sealer has sealed, each of them once.
class Opener {
public:
    /// The number of states behind the newest one that are still accepted: 8 s at 1 kHz.
    static constexpr std::size_t state_window = 8192;
    static constexpr std::size_t control_window = 64;

    explicit Opener(Secret key) : key_{std::move(key)} {}

    enum class Outcome : std::uint8_t {
        opened,
        opened_newest, // no message of its kind has a greater number
        replayed,      // opened before, or too old to tell; not opened this time
        forged,        // not sealed with this key
    };
    /// Opens a message in place. Only a genuine message moves the window.
    [[nodiscard]] Outcome open(Kind kind, std::uint32_t number, Bytes associated,
                               std::span<std::byte> room);

private:
    Secret key_;
    base::RecentNumbers<state_window> states_; // numbers of the opened states
    base::RecentNumbers<control_window> controls_;
};

} // namespace hapnet::secure
