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

/// Keys, the handshake that makes session keys, and the sealing of messages. They ensure that only
/// members of the circle can move a hand.
namespace hapnet::secure {

// The functions that Noise names 25519, ChaChaPoly and BLAKE2b, implemented with libsodium. Only
// this file and keys/, which draws at random, call libsodium.

inline constexpr std::size_t key_bytes = 32;
inline constexpr std::size_t hash_bytes = 64;
inline constexpr std::size_t tag_bytes = 16;

using Bytes = std::span<const std::byte>;
using PublicKey = std::array<std::byte, key_bytes>;
using Hash = std::array<std::byte, hash_bytes>;
using Mac = std::array<std::byte, 16>;

/// Overwrites memory in a way that no compiler removes.
void wipe(std::span<std::byte> bytes);

/// Secret bytes. They can be moved but not copied. A move leaves zeros.
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
/// A key of the cipher, a private key of the curve, a pre-shared key, or a secret that two sides
/// share.
using Secret = SecretBytes<key_bytes>;
using SecretHash = SecretBytes<hash_bytes>;

/// Selects the fastest code for this processor. Call it once before anything below; further calls
/// are allowed, from any thread. The program ends here if there is no source of randomness.
void prepare();

/// BLAKE2b (RFC 7693) of several parts, one after the other.
class Blake2b {
public:
    /// `size` is that of the result: 16 to 64 bytes. The key is empty or has 16 to 64 bytes.
    explicit Blake2b(std::size_t size, Bytes key = {});
    Blake2b(const Blake2b&) = delete;
    Blake2b& operator=(const Blake2b&) = delete;
    ~Blake2b();

    Blake2b& add(Bytes part);
    /// Writes the result. Call it once.
    void end(std::span<std::byte> result);

private:
    alignas(64) std::array<std::byte, 384> state_; // state of libsodium's hash
    std::size_t size_;
};

/// Returns the BLAKE2b hash, with 64 bytes, of the concatenated parts.
[[nodiscard]] Hash hash(Bytes first, Bytes second = {});
/// Returns the BLAKE2b hash, with 16 bytes, under a key of 16 to 64 bytes.
[[nodiscard]] Mac keyed_hash(Bytes key, Bytes first, Bytes second = {});

/// The result of HKDF as Noise defines it (revision 34, section 4.3), with HMAC-BLAKE2b (RFC 2104;
/// block 128).
using Expanded = std::array<SecretHash, 3>;
[[nodiscard]] Expanded expand(const SecretHash& chaining_key, Bytes input);
/// Returns the HMAC-BLAKE2b with 64 bytes.
[[nodiscard]] SecretHash authenticate(Bytes key, Bytes first, Bytes second = {});

/// Returns the X25519 public key of a private key.
[[nodiscard]] PublicKey public_key_of(const Secret& own);
/// Computes X25519 (RFC 7748). Returns nullopt if the other key is not valid, because it makes
/// every result zero or is not a number below 2^255 - 19. The curve would take such a number for
/// another one, so that one key could be written in two ways.
[[nodiscard]] std::optional<Secret> diffie_hellman(const Secret& own, const PublicKey& other);

/// Seals with ChaCha20-Poly1305 (RFC 8439) and Noise's nonce: four zeros, then the number in
/// little-endian order. No number may be used twice with a key. `room` contains the text and after
/// it `tag_bytes` free bytes; both are overwritten.
void seal(const Secret& key, std::uint64_t number, Bytes associated, std::span<std::byte> room);
/// Reverses seal() in place. Returns false if `room` was not sealed in this way; its content must
/// not be used then.
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
/// Parses a key of this many bytes. Returns nullopt for any text that to_base64() would not write.
[[nodiscard]] std::optional<std::array<std::byte, key_bytes>>
key_from_base64(std::string_view text);

} // namespace hapnet::secure
