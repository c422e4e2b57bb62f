// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/primitives.hpp"

#include "proto/base/bytes.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <sodium.h>

namespace hapnet::secure {

static_assert(key_bytes == crypto_scalarmult_BYTES);
static_assert(key_bytes == crypto_scalarmult_SCALARBYTES);
static_assert(key_bytes == crypto_aead_chacha20poly1305_ietf_KEYBYTES);
static_assert(key_bytes == crypto_aead_xchacha20poly1305_ietf_KEYBYTES);
static_assert(tag_bytes == crypto_aead_chacha20poly1305_ietf_ABYTES);
static_assert(tag_bytes == crypto_aead_xchacha20poly1305_ietf_ABYTES);
static_assert(wide_nonce_bytes == crypto_aead_xchacha20poly1305_ietf_NPUBBYTES);
static_assert(hash_bytes == crypto_generichash_BYTES_MAX);

namespace {

// Converts bytes to the type of libsodium. Reading any object as unsigned char is allowed.
const unsigned char* raw(Bytes bytes)
{
    return reinterpret_cast<const unsigned char*>(bytes.data()); // NOLINT(*-reinterpret-cast)
}
unsigned char* raw_room(std::span<std::byte> bytes)
{
    return reinterpret_cast<unsigned char*>(bytes.data()); // NOLINT(*-reinterpret-cast)
}

crypto_generichash_state* state_in(std::span<std::byte> room)
{
    return reinterpret_cast<crypto_generichash_state*>(room.data()); // NOLINT(*-reinterpret-cast)
}

std::array<std::byte, crypto_aead_chacha20poly1305_ietf_NPUBBYTES> nonce_of(std::uint64_t number)
{
    std::array<std::byte, crypto_aead_chacha20poly1305_ietf_NPUBBYTES> nonce{};
    base::ByteWriter writer{nonce};
    writer.u32(0);
    writer.u64(number);
    return nonce;
}

/// True if the key, in little-endian order, is below the prime of the curve.
bool is_canonical(const PublicKey& key)
{
    constexpr PublicKey prime = [] {
        PublicKey bytes{};
        bytes.fill(std::byte{0xff});
        bytes.front() = std::byte{0xed};
        bytes.back() = std::byte{0x7f};
        return bytes;
    }();
    return std::ranges::lexicographical_compare(key.rbegin(), key.rend(), prime.rbegin(),
                                                prime.rend());
}

} // namespace

// NOLINTNEXTLINE(*-member-init): the library does that
Blake2b::Blake2b(std::size_t size, Bytes key) : size_{size}
{
    static_assert(sizeof state_ == sizeof(crypto_generichash_state));
    static_assert(alignof(Blake2b) >= alignof(crypto_generichash_state));
    base::ensure(crypto_generichash_init(state_in(state_), raw(key), key.size(), size) == 0);
}

Blake2b::~Blake2b() { wipe(state_); }

Blake2b& Blake2b::add(Bytes part)
{
    base::ensure(crypto_generichash_update(state_in(state_), raw(part), part.size()) == 0);
    return *this;
}

void Blake2b::end(std::span<std::byte> result)
{
    base::ensure(result.size() == size_);
    base::ensure(crypto_generichash_final(state_in(state_), raw_room(result), size_) == 0);
}

void wipe(std::span<std::byte> bytes) { sodium_memzero(bytes.data(), bytes.size()); }

void prepare() { base::ensure(sodium_init() >= 0); }

Hash hash(Bytes first, Bytes second)
{
    Hash result;
    Blake2b{hash_bytes}.add(first).add(second).end(result);
    return result;
}

Mac keyed_hash(Bytes key, Bytes first, Bytes second)
{
    Mac result;
    Blake2b{result.size(), key}.add(first).add(second).end(result);
    return result;
}

SecretHash authenticate(Bytes key, Bytes first, Bytes second)
{
    constexpr std::size_t block = 128;
    base::ensure(key.size() <= block); // all keys in use are that short
    SecretBytes<block> inner, outer;
    std::ranges::copy(key, inner.bytes().begin());
    std::ranges::copy(key, outer.bytes().begin());
    for (std::byte& each : inner.bytes()) each ^= std::byte{0x36};
    for (std::byte& each : outer.bytes()) each ^= std::byte{0x5c};
    SecretHash within, result;
    Blake2b{hash_bytes}.add(inner.bytes()).add(first).add(second).end(within.bytes());
    Blake2b{hash_bytes}.add(outer.bytes()).add(within.bytes()).end(result.bytes());
    return result;
}

Expanded expand(const SecretHash& chaining_key, Bytes input)
{
    const SecretHash temporary = authenticate(chaining_key.bytes(), input);
    const auto counter = [](std::uint8_t i) { return std::array{std::byte{i}}; };
    Expanded outputs;
    outputs[0] = authenticate(temporary.bytes(), counter(1));
    outputs[1] = authenticate(temporary.bytes(), outputs[0].bytes(), counter(2));
    outputs[2] = authenticate(temporary.bytes(), outputs[1].bytes(), counter(3));
    return outputs;
}

PublicKey public_key_of(const Secret& own)
{
    PublicKey result;
    base::ensure(crypto_scalarmult_base(raw_room(result), raw(own.bytes())) == 0);
    return result;
}

std::optional<Secret> diffie_hellman(const Secret& own, const PublicKey& other)
{
    if (!is_canonical(other)) return std::nullopt;
    Secret shared;
    if (crypto_scalarmult(raw_room(shared.bytes()), raw(own.bytes()), raw(other)) != 0)
        return std::nullopt;
    return shared;
}

void seal(const Secret& key, std::uint64_t number, Bytes associated, std::span<std::byte> room)
{
    base::ensure(room.size() >= tag_bytes);
    const auto nonce = nonce_of(number);
    unsigned long long size = 0;
    crypto_aead_chacha20poly1305_ietf_encrypt(
        raw_room(room), &size, raw(room), room.size() - tag_bytes, raw(associated),
        associated.size(), nullptr, raw(nonce), raw(key.bytes()));
    base::ensure(size == room.size());
}

bool open(const Secret& key, std::uint64_t number, Bytes associated, std::span<std::byte> room)
{
    const auto nonce = nonce_of(number);
    unsigned long long size = 0;
    return crypto_aead_chacha20poly1305_ietf_decrypt(
               raw_room(room), &size, nullptr, raw(room), room.size(), raw(associated),
               associated.size(), raw(nonce), raw(key.bytes())) == 0;
}

void seal(const Secret& key, const WideNonce& nonce, Bytes associated, std::span<std::byte> room)
{
    base::ensure(room.size() >= tag_bytes);
    unsigned long long size = 0;
    crypto_aead_xchacha20poly1305_ietf_encrypt(
        raw_room(room), &size, raw(room), room.size() - tag_bytes, raw(associated),
        associated.size(), nullptr, raw(nonce), raw(key.bytes()));
    base::ensure(size == room.size());
}

bool open(const Secret& key, const WideNonce& nonce, Bytes associated, std::span<std::byte> room)
{
    unsigned long long size = 0;
    return crypto_aead_xchacha20poly1305_ietf_decrypt(
               raw_room(room), &size, nullptr, raw(room), room.size(), raw(associated),
               associated.size(), raw(nonce), raw(key.bytes())) == 0;
}

bool are_equal(Bytes a, Bytes b)
{
    return a.size() == b.size() && sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

bool is_zero(Bytes bytes) { return sodium_is_zero(raw(bytes), bytes.size()) == 1; }

std::string to_base64(Bytes bytes)
{
    constexpr int variant = sodium_base64_VARIANT_ORIGINAL;
    std::string text(sodium_base64_encoded_len(bytes.size(), variant), '\0');
    sodium_bin2base64(text.data(), text.size(), raw(bytes), bytes.size(), variant);
    text.pop_back(); // the terminating zero
    return text;
}

std::optional<std::array<std::byte, key_bytes>> key_from_base64(std::string_view text)
{
    std::array<std::byte, key_bytes> bytes{};
    std::size_t size = 0;
    const bool is_base64 =
        sodium_base642bin(raw_room(bytes), bytes.size(), text.data(), text.size(), nullptr, &size,
                          nullptr, sodium_base64_VARIANT_ORIGINAL) == 0;
    if (!is_base64 || size != bytes.size()) return std::nullopt;
    return bytes;
}

} // namespace hapnet::secure
