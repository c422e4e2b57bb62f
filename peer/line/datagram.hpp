// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"
#include "proto/secure/frames.hpp"
#include "proto/wire/message.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <span>

namespace hapnet::peer::line {

/// The bytes of one datagram on the network, sealed or plain. The cost of a copy depends on their
/// number.
class Datagram { // NOLINT(*-member-init): what is behind the bytes is never read
public:
    static constexpr std::size_t bytes_max = wire::message_bytes_max + secure::control_overhead;

    Datagram() = default;                                                  // NOLINT(*-member-init)
    explicit Datagram(std::span<const std::byte> bytes) { assign(bytes); } // NOLINT(*-member-init)
    Datagram(const Datagram& other) { assign(other.bytes()); }             // NOLINT(*-member-init)
    ~Datagram() = default;
    Datagram& operator=(const Datagram& other)
    {
        if (this != &other) assign(other.bytes());
        return *this;
    }

    [[nodiscard]] std::span<const std::byte> bytes() const { return {bytes_.data(), size_}; }
    /// Replaces the bytes. Ensures that there is room for them.
    void assign(std::span<const std::byte> bytes)
    {
        base::ensure(bytes.size() <= bytes_max);
        size_ = bytes.size();
        if (size_ > 0) std::memcpy(bytes_.data(), bytes.data(), size_);
    }
    /// Returns the whole buffer, so that the bytes can be changed in place.
    [[nodiscard]] std::span<std::byte> room() { return bytes_; }

private:
    std::array<std::byte, bytes_max> bytes_;
    std::size_t size_ = 0;
};

} // namespace hapnet::peer::line
