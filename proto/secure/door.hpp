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

/// An address and a port as bytes. A shell fills them in; a core only compares them.
using Place = std::array<std::byte, 18>;

/// True if two places are equal. It is called for every datagram, and `==` would compare byte by
/// byte.
[[nodiscard]] inline bool is_same(const Place& a, const Place& b)
{
    return std::memcmp(a.data(), b.data(), a.size()) == 0;
}

/// Returns the key of the first MAC of handshake messages to `receiver`. This MAC is checked before
/// anything more expensive. All members of the circle can compute the key; in a circle without a
/// pre-shared key, only the two sides can.
[[nodiscard]] Hash key_of_mac1(const StaticKeys& keys, const PublicKey& receiver);

/// Decides which messages are worth the work of a handshake, so that a forged initiation costs one
/// hash. If there are more genuine initiations than a peer has reason to send, some are replays of
/// captured ones. Then an initiation needs a cookie, which proves that the sender can be reached at
/// its address (as in WireGuard, section 5.3 of its paper). Keeps no state per sender.
class Door {
public:
    /// The number of initiations in a second above which a cookie is required.
    static constexpr std::uint32_t handshakes_per_second_max = 20;
    static constexpr base::Duration secret_lasts{std::chrono::seconds{120}};

    Door(const Hash& own_mac1_key, Secret seed);

    /// True if the first MAC of a handshake message is valid for this peer. Check this first.
    [[nodiscard]] bool knows_us(Bytes covered, Bytes mac1) const;
    /// True if a genuine initiation is accepted, because it needs no cookie or contains a valid
    /// one.
    [[nodiscard]] bool lets_in(const Initiation& initiation, const Place& from,
                               base::TimePoint now);
    /// Returns the answer to an initiation that is not accepted.
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

/// The sender's side of Door: the cookie that was received for the last handshake message of this
/// side.
class CookieJar {
public:
    static constexpr base::Duration cookie_lasts = Door::secret_lasts;

    explicit CookieJar(const Hash& other_mac1_key);

    /// Stores the cookie if the reply answers the message with that MAC. Returns false otherwise.
    bool take(const CookieReply& reply, Bytes mac1_sent, base::TimePoint now);
    [[nodiscard]] std::optional<Mac> cookie(base::TimePoint now) const;

private:
    Secret key_;
    std::optional<Mac> cookie_;
    base::TimePoint since_;
};

} // namespace hapnet::secure
