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
    std::vector<Member> others; // sorted by their ids

    [[nodiscard]] bool has_pre_shared() const { return !is_zero(pre_shared.bytes()); }
    /// Returns the member with that id; nullptr if the circle has none.
    [[nodiscard]] const Member* find(std::uint8_t peer) const;
    /// Returns the keys for an association with a member of the circle.
    [[nodiscard]] StaticKeys keys_with(const Member& member) const;
    /// Returns the name of the circle in the form that handshakes contain.
    [[nodiscard]] std::array<std::byte, 8> circle() const;
    /// Returns twelve groups of five decimal digits (199 bits), for comparison by telephone. They
    /// are equal on all hosts of a circle that hold the same keys, and reveal nothing about the
    /// keys. An attacker between two hosts would have to try 2^99 keys to find two with similar
    /// digits.
    [[nodiscard]] std::string fingerprint() const;
};

/// Parses the text of a key file. `source` names it in complaints, which never quote a secret.
[[nodiscard]] base::Result<KeyFile> parse_key_file(std::string_view text,
                                                   const std::string& source);
/// Returns a text that parses to the same key file. It contains the secrets.
[[nodiscard]] std::string print_key_file(const KeyFile& file);

/// Parses a circle's shared key alone, a text for hosts that do not have it yet: `psk = "BASE64"`.
[[nodiscard]] base::Result<Secret> parse_shared_key(std::string_view text,
                                                    const std::string& source);
[[nodiscard]] std::string print_shared_key(const Secret& key);

/// Makes the key files of a new circle with the ids 1 to `count` (at most KeyFile::id_max), one for
/// each host.
[[nodiscard]] std::vector<KeyFile> make_circle(const std::string& name, std::uint8_t count,
                                               Entropy& entropy);

} // namespace hapnet::secure
