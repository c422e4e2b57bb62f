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
/// The endpoint is either configured and never changes, or it is the first sender, which is
/// adopted. When an adopted sender has been silent for `silence_max`, the next sender replaces it,
/// so that a program that died can be started again on another port. While it sends, no other
/// sender replaces it.
template <typename Address>
class EndpointFilter {
public:
    static constexpr base::Duration silence_max = std::chrono::seconds{1};

    /// Without an address the filter adopts the first sender.
    explicit EndpointFilter(std::optional<Address> configured)
        : address_{std::move(configured)}, adopts_{!address_}
    {}

    /// Judges the sender of a datagram that came from `from` and arrived at `at`, and may adopt it.
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

    /// Returns the address; nullopt until an endpoint is adopted.
    [[nodiscard]] const std::optional<Address>& address() const { return address_; }

    /// Returns the arrival time of its last datagram.
    [[nodiscard]] base::TimePoint heard_at() const { return heard_; }

    /// True if another sender may replace a silent one.
    [[nodiscard]] bool adopts() const { return adopts_; }

private:
    std::optional<Address> address_;
    bool adopts_;
    base::TimePoint heard_{};
};

} // namespace hapnet::emulator
