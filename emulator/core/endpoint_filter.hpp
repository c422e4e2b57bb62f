// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>

namespace hapnet::emulator {

/// The sender of a datagram, as the filter knows it.
enum class Sender : std::uint8_t {
    known,
    adopted, // known from now on
    unknown,
};

/// Decides which endpoint may use one side of the emulator, and where that side's datagrams go.
///
/// Either it is configured and never changes, or the first sender is adopted. An adopted sender
/// that has been silent for `silence_max` gives way to the next one, so that a program which died
/// can be started again on another port; as long as it sends, no other takes its place.
template <typename Address>
class EndpointFilter {
public:
    static constexpr base::Duration silence_max = std::chrono::seconds{1};

    /// Without an address the filter adopts one.
    explicit EndpointFilter(std::optional<Address> configured)
        : address_{std::move(configured)}, adopts_{!address_}
    {}

    /// Judges the sender of a datagram that came from `from` and arrived at `at`. May adopt it.
    [[nodiscard]] Sender classify(const Address& from, base::TimePoint at)
    {
        const bool known = address_ == from;
        if (!known && (!adopts_ || (address_ && at - heard_ < silence_max))) {
            return Sender::unknown;
        }
        heard_ = at;
        if (known) return Sender::known;
        address_ = from;
        return Sender::adopted;
    }

    /// The address; nullopt until an endpoint is adopted.
    [[nodiscard]] const std::optional<Address>& address() const { return address_; }

    /// The time when its last datagram came.
    [[nodiscard]] base::TimePoint heard_at() const { return heard_; }

    /// True if another sender may take the place of a silent one.
    [[nodiscard]] bool adopts() const { return adopts_; }

private:
    std::optional<Address> address_;
    bool adopts_;
    base::TimePoint heard_{};
};

} // namespace hapnet::emulator
