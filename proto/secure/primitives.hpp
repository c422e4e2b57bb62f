// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

/// Keys, the handshake that makes session keys, and the sealing of messages. They decide which
/// peers may move a hand.
namespace hapnet::secure {

// The functions that Noise names 25519, ChaChaPoly and BLAKE2b, by libsodium. Only this file and
// keys/, which draws at random, call libsodium.

inline constexpr std::size_t key_bytes = 32;
inline constexpr std::size_t hash_bytes = 64;
inline constexpr std::size_t tag_bytes = 16;

using Bytes = std::span<const std::byte>;
using PublicKey = std::array<std::byte, key_bytes>;
using Hash = std::array<std::byte, hash_bytes>;
using Mac = std::array<std::byte, 16>;

/// Overwrites memory so that no compiler leaves it out.
void wipe(std::span<std::byte> bytes);

/// Secret bytes. They move and are never copied, and zeros are left where they were.
template <std::size_t count>
class SecretBytes {
public:
    SecretBytes() = default; // zeros
    explicit SecretBytes(std::span<const std::byte, count> bytes)
    {
        for (std::size_t i = 0; i < count; ++i) bytes_[i] = bytes[i];
    }
    SecretBytes(SecretBytes&& other) noexcept : bytes_{other.bytes_} { wipe(other.bytes_); }
    SecretBytes& operator=(SecretBytes&& other) noexcept
    {
        if (this == &other) return *this;
        bytes_ = other.bytes_;
        wipe(other.bytes_);
        return *this;
    }
    SecretBytes(const SecretBytes&) = delete;
    SecretBytes& operator=(const SecretBytes&) = delete;
    ~SecretBytes() { wipe(bytes_); }

    [[nodiscard]] std::span<const std::byte, count> bytes() const { return bytes_; }
    [[nodiscard]] std::span<std::byte, count> bytes() { return bytes_; }
    /// Returns a copy, for the few places where one secret has two owners.
    [[nodiscard]] SecretBytes copy() const { return SecretBytes{bytes()}; }

private:
    std::array<std::byte, count> bytes_{};
};
/// A key of the cipher, a private key of the curve, a pre-shared key, or what two sides share.
using Secret = SecretBytes<key_bytes>;
using SecretHash = SecretBytes<hash_bytes>;

/// Chooses the fastest code for this processor; call it once before anything below. It may be
/// called again, from any thread. Without a source of randomness the program ends here.
void prepare();

/// BLAKE2b (RFC 7693) of parts, one after the other.
class Blake2b {
public:
    /// `size` of the result: 16 to 64 bytes. A key has as many, or is empty.
    explicit Blake2b(std::size_t size, Bytes key = {});
    Blake2b(const Blake2b&) = delete;
    Blake2b& operator=(const Blake2b&) = delete;
    ~Blake2b();

    Blake2b& add(Bytes part);
    /// Writes the result, once.
    void end(std::span<std::byte> result);

private:
    alignas(64) std::array<std::byte, 384> state_; // state of libsodium's hash
    std::size_t size_;
};

/// BLAKE2b with 64 bytes over the parts one after the other.
[[nodiscard]] Hash hash(Bytes first, Bytes second = {});
/// BLAKE2b with 16 bytes under a key of 16 to 64 bytes.
[[nodiscard]] Mac keyed_hash(Bytes key, Bytes first, Bytes second = {});

/// HKDF as Noise defines it (revision 34, section 4.3), with HMAC-BLAKE2b (RFC 2104; block 128).
using Expanded = std::array<SecretHash, 3>;
[[nodiscard]] Expanded expand(const SecretHash& chaining_key, Bytes input);
/// HMAC-BLAKE2b with 64 bytes.
[[nodiscard]] SecretHash authenticate(Bytes key, Bytes first, Bytes second = {});

/// The X25519 public key of a private one.
[[nodiscard]] PublicKey public_key_of(const Secret& own);
/// X25519 (RFC 7748). nullopt when the other's key is not valid: one of the few that make every
/// result zero, or a number that is not below 2^255 - 19. The curve would take such a number for
/// another one, so that one key could be written in two ways.
[[nodiscard]] std::optional<Secret> diffie_hellman(const Secret& own, const PublicKey& other);

/// ChaCha20-Poly1305 (RFC 8439) with Noise's nonce: four zeros, then the number in little-endian
/// order. No number may be used twice under a key. `room` holds the text and after it `tag_bytes`
/// free bytes; both are overwritten.
void seal(const Secret& key, std::uint64_t number, Bytes associated, std::span<std::byte> room);
/// Undoes it in place. False: not sealed so, and nothing of `room` may be read.
[[nodiscard]] bool open(const Secret& key, std::uint64_t number, Bytes associated,
                        std::span<std::byte> room);

/// Seals and opens with XChaCha20-Poly1305, whose nonces may be drawn at random.
inline constexpr std::size_t wide_nonce_bytes = 24;
using WideNonce = std::array<std::byte, wide_nonce_bytes>;
void seal(const Secret& key, const WideNonce& nonce, Bytes associated, std::span<std::byte> room);
[[nodiscard]] bool open(const Secret& key, const WideNonce& nonce, Bytes associated,
                        std::span<std::byte> room);

/// True if the two are equal. The time does not depend on where they differ.
[[nodiscard]] bool are_equal(Bytes a, Bytes b);

/// True if all bytes are zero. The time does not depend on the bytes.
[[nodiscard]] bool is_zero(Bytes bytes);

/// Base 64 (RFC 4648, with padding), in a time that does not depend on the bytes.
[[nodiscard]] std::string to_base64(Bytes bytes);
/// Parses a key of this many bytes. nullopt for other text, and for text that to_base64() would not
/// write.
[[nodiscard]] std::optional<std::array<std::byte, key_bytes>>
key_from_base64(std::string_view text);

} // namespace hapnet::secure
