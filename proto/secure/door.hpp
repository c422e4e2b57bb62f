// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/secure/entropy.hpp"
#include "proto/secure/frames.hpp"
#include "proto/secure/noise_kk.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>

namespace hapnet::secure {

/// An address and a port as bytes that a shell fills in; a core only compares them.
using Place = std::array<std::byte, 18>;

/// Compares two places. It is called for every datagram, and `==` would compare byte by byte.
[[nodiscard]] inline bool is_same(const Place& a, const Place& b)
{
    return std::memcmp(a.data(), b.data(), a.size()) == 0;
}

/// The key of the first MAC of handshake messages to `receiver`, which is checked before anything
/// that costs more. Members of the circle can make it; where the circle has no pre-shared key, only
/// the two sides can.
[[nodiscard]] Hash key_of_mac1(const StaticKeys& keys, const PublicKey& receiver);

/// Lets in the messages that deserve a handshake's work: a forged initiation costs one hash. More
/// genuine initiations than a peer has reason to send are repeats of captured ones; then only a
/// sender that can be reached at its address gets in, with a cookie (as in WireGuard, section 5.3
/// of its paper). Holds nothing per sender.
class Door {
public:
    /// More initiations in a second ask for a cookie.
    static constexpr std::uint32_t handshakes_per_second_max = 20;
    static constexpr base::Duration secret_lasts{std::chrono::seconds{120}};

    Door(const Hash& own_mac1_key, Secret seed);

    /// True if the first MAC of a handshake message is valid for this peer. Check this first.
    [[nodiscard]] bool knows_us(Bytes covered, Bytes mac1) const;
    /// True if a genuine initiation gets in without a cookie, or has brought one.
    [[nodiscard]] bool lets_in(const Initiation& initiation, const Place& from,
                               base::TimePoint now);
    /// The answer when it does not.
    [[nodiscard]] HandshakeFrame cookie_reply(const Initiation& initiation, const Place& from,
                                              base::TimePoint now);

private:
    [[nodiscard]] bool is_busy(base::TimePoint now);
    [[nodiscard]] Mac cookie_for(const Place& place, base::TimePoint now);

    Hash mac1_key_;
    Entropy entropy_;
    Secret cookie_secret_;
    std::optional<base::TimePoint> cookie_secret_since_;
    base::TimePoint second_began_;
    std::uint32_t in_this_second_ = 0;
};

/// The other end of that: the cookie that was sent for our last handshake message.
class CookieJar {
public:
    static constexpr base::Duration cookie_lasts = Door::secret_lasts;

    explicit CookieJar(const Hash& other_mac1_key);

    /// Takes it when it answers the message with that MAC.
    bool take(const CookieReply& reply, Bytes mac1_sent, base::TimePoint now);
    [[nodiscard]] std::optional<Mac> cookie(base::TimePoint now) const;

private:
    Secret key_;
    std::optional<Mac> cookie_;
    base::TimePoint since_;
};

} // namespace hapnet::secure
