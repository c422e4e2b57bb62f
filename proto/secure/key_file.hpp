// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/secure/entropy.hpp"
#include "proto/secure/noise_kk.hpp"
#include "proto/secure/primitives.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::secure {

/// The keys that a host needs in a circle of peers: its own private key, the public keys of all
/// other members, and a key that all members share. As text:
///
///     name = "lab"                 # of the circle
///     id = 1
///     secret = "BASE64"            # of this host alone
///     psk = "BASE64"               # of the circle; without it all zeros
///     [[peer]]
///     id = 2
///     public = "BASE64"
///     endpoint = "10.0.0.2:7000"   # where to begin; may be missing
struct KeyFile {
    static constexpr std::uint8_t id_max = 31;
    static constexpr std::size_t name_bytes_max = 64;

    struct Member {
        std::uint8_t id = 0;
        PublicKey key{};
        std::string endpoint; // empty: not given
    };

    std::string name;
    std::uint8_t id = 1;
    Secret own;
    Secret pre_shared;
    std::vector<Member> others; // in the order of their ids

    [[nodiscard]] bool has_pre_shared() const { return !is_zero(pre_shared.bytes()); }
    /// nullptr when no such peer is in the circle.
    [[nodiscard]] const Member* find(std::uint8_t peer) const;
    /// Returns the keys for an association with that peer, which is a member of the circle.
    [[nodiscard]] StaticKeys keys_with(const Member& member) const;
    /// The circle's name as handshakes carry it.
    [[nodiscard]] std::array<std::byte, 8> circle() const;
    /// Twelve groups of five decimal digits (199 bits), to be compared by telephone. They are the
    /// same on every host of a circle whose hosts hold the same keys, and reveal nothing of the
    /// keys. An attacker between two hosts would have to try 2^99 keys to find two with similar
    /// digits.
    [[nodiscard]] std::string fingerprint() const;
};

/// Reads the text of a key file; `source` names it in complaints, which never quote a secret.
[[nodiscard]] base::Result<KeyFile> parse_key_file(std::string_view text,
                                                   const std::string& source);
/// Text that reads back as the same; it holds the secrets.
[[nodiscard]] std::string print_key_file(const KeyFile& file);

/// A circle's shared key alone, as text for the hosts that do not have it yet: `psk = "BASE64"`.
[[nodiscard]] base::Result<Secret> parse_shared_key(std::string_view text,
                                                    const std::string& source);
[[nodiscard]] std::string print_shared_key(const Secret& key);

/// The files of a new circle with the ids 1 to `count` (at most KeyFile::id_max), each for its host
/// alone.
[[nodiscard]] std::vector<KeyFile> make_circle(const std::string& name, std::uint8_t count,
                                               Entropy& entropy);

} // namespace hapnet::secure
