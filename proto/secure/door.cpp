// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/door.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace hapnet::secure {

namespace {

Bytes text(std::string_view words) { return std::as_bytes(std::span{words}); }

/// Returns the key of cookies, which every peer that knows the other side's key can compute.
Secret key_of_cookies(const Hash& mac1_key)
{
    const Hash key = hash(text("hapnet cookie"), mac1_key);
    return Secret{std::span{key}.first<key_bytes>()};
}

} // namespace

Hash key_of_mac1(const StaticKeys& keys, const PublicKey& receiver)
{
    const Secret& secret = keys.has_pre_shared() ? keys.pre_shared() : keys.common();
    SecretBytes<13 + key_bytes> known; // "hapnet mac1" and what follows, in one piece
    const auto words = text("hapnet mac1: ");
    std::ranges::copy(words, known.bytes().begin());
    std::ranges::copy(secret.bytes(), known.bytes().begin() + 13);
    return hash(known.bytes(), receiver);
}

Door::Door(const Hash& own_mac1_key, Secret seed)
    : mac1_key_{own_mac1_key}, entropy_{std::move(seed)}
{}

bool Door::knows_us(Bytes covered, Bytes mac1) const
{
    return are_equal(keyed_hash(mac1_key_, covered), mac1);
}

bool Door::is_busy(base::TimePoint now)
{
    if (now - second_began_ >= std::chrono::seconds{1}) {
        second_began_ = now;
        in_this_second_ = 0;
    }
    return ++in_this_second_ > handshakes_per_second_max;
}

bool Door::lets_in(const Initiation& initiation, const Place& from, base::TimePoint now)
{
    if (!is_busy(now)) return true;
    const Mac expected = keyed_hash(cookie_for(from, now), initiation.macs.covered_by_mac2);
    return are_equal(expected, initiation.macs.mac2);
}

Mac Door::cookie_for(const Place& place, base::TimePoint now)
{
    if (!cookie_secret_since_ || now - *cookie_secret_since_ >= secret_lasts) {
        cookie_secret_ = entropy_.secret();
        cookie_secret_since_ = now;
    }
    return keyed_hash(cookie_secret_.bytes(), place);
}

HandshakeFrame Door::cookie_reply(const Initiation& initiation, const Place& from,
                                  base::TimePoint now)
{
    const Mac cookie = cookie_for(from, now);
    std::array<std::byte, sizeof(Mac) + tag_bytes> sealed{};
    std::ranges::copy(cookie, sealed.begin());
    const WideNonce nonce = entropy_.bytes<wide_nonce_bytes>();
    seal(key_of_cookies(mac1_key_), nonce, initiation.macs.mac1, sealed);
    return HandshakeFrame::cookie(initiation.sender, nonce, sealed);
}

CookieJar::CookieJar(const Hash& other_mac1_key) : key_{key_of_cookies(other_mac1_key)} {}

bool CookieJar::take(const CookieReply& reply, Bytes mac1_sent, base::TimePoint now)
{
    std::array<std::byte, sizeof(Mac) + tag_bytes> room{};
    std::ranges::copy(reply.sealed, room.begin());
    if (!open(key_, reply.nonce, mac1_sent, room)) return false;
    cookie_.emplace();
    std::copy_n(room.begin(), cookie_->size(), cookie_->begin());
    since_ = now;
    return true;
}

std::optional<Mac> CookieJar::cookie(base::TimePoint now) const
{
    if (!cookie_ || now - since_ >= cookie_lasts) return std::nullopt;
    return cookie_;
}

} // namespace hapnet::secure
