// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/noise_kk.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace hapnet::secure {

namespace {

constexpr std::string_view protocol_name = "Noise_KKpsk0_25519_ChaChaPoly_BLAKE2b";
static_assert(protocol_name.size() <= hash_bytes); // so the name is padded, not hashed

Secret key_from(const SecretHash& output) { return Secret{output.bytes().first<key_bytes>()}; }

} // namespace

std::optional<StaticKeys> StaticKeys::from(Secret own, const PublicKey& other, Secret shared)
{
    auto common = diffie_hellman(own, other);
    if (!common) return std::nullopt;
    return StaticKeys{std::move(own), other, std::move(shared), std::move(*common)};
}

NoiseKk::NoiseKk(Role role, const StaticKeys& keys, Bytes prologue, Secret ephemeral)
    : role_{role}, keys_{keys}, ephemeral_{std::move(ephemeral)}
{
    std::ranges::copy(std::as_bytes(std::span{protocol_name}), state_.hash.begin());
    state_.chaining_key = SecretHash{state_.hash};
    mix_hash(prologue);
    const bool is_initiator = role == Role::initiator;
    mix_hash(is_initiator ? keys.own_public() : keys.other());
    mix_hash(is_initiator ? keys.other() : keys.own_public());
}

void NoiseKk::mix_hash(Bytes data) { state_.hash = hash(state_.hash, data); }

void NoiseKk::mix_key(Bytes input)
{
    Expanded outputs = expand(state_.chaining_key, input);
    state_.chaining_key = std::move(outputs[0]);
    state_.key = key_from(outputs[1]);
    state_.number = 0;
}

void NoiseKk::mix_key_and_hash(Bytes input)
{
    Expanded outputs = expand(state_.chaining_key, input);
    state_.chaining_key = std::move(outputs[0]);
    mix_hash(outputs[1].bytes());
    state_.key = key_from(outputs[2]);
    state_.number = 0;
}

void NoiseKk::begin(std::size_t size, bool writes)
{
    const bool is_own_turn = (message_ == 0) == (role_ == Role::initiator);
    base::ensure(!is_under_way_ && message_ < messages.size());
    base::ensure(is_own_turn == writes);
    is_under_way_ = true;
    is_refused_ = false;
    before_ = state_.copy();
    writes_ = writes;
    token_ = 0;
    size_ = size;
}

void NoiseKk::write(Bytes payload)
{
    base::ensure(payload.size() <= payload_bytes_max);
    begin(key_bytes + payload.size() + tag_bytes, true);
    std::ranges::copy(payload, buffer_.begin() + key_bytes);
}

void NoiseKk::read(Bytes message)
{
    begin(std::min(message.size(), message_bytes_max), false);
    is_refused_ = message.size() < key_bytes + tag_bytes || message.size() > message_bytes_max;
    if (!is_refused_) std::ranges::copy(message, buffer_.begin());
}

NoiseKk::Progress NoiseKk::step()
{
    base::ensure(is_under_way_);
    const Tokens& tokens = messages[message_];
    for (bool has_multiplied = false; !is_refused_ && token_ < tokens.count; ++token_) {
        const Token token = tokens.all[token_];
        if (multiplies(token) && std::exchange(has_multiplied, true)) return Progress::working;
        apply(token);
    }
    return is_refused_ ? refuse() : finish();
}

NoiseKk::Progress NoiseKk::refuse()
{
    state_ = std::move(before_);
    is_under_way_ = false;
    return Progress::refused;
}

bool NoiseKk::multiplies(Token token) const
{
    switch (token) {
    case Token::psk:
    case Token::ss: return false; // no multiplication: these secrets are known before
    case Token::e: return writes_;
    case Token::es:
    case Token::ee:
    case Token::se: return true;
    }
    return true;
}

void NoiseKk::apply(Token token)
{
    const bool is_initiator = role_ == Role::initiator;
    switch (token) {
    case Token::psk: mix_key_and_hash(keys_.pre_shared().bytes()); break;
    case Token::e: mix_ephemeral(); break;
    case Token::ss: mix_key(keys_.common().bytes()); break;
    case Token::ee: mix_shared(ephemeral_, other_ephemeral_); break;
    case Token::es: // the initiator's ephemeral key, the responder's static one
        if (is_initiator) {
            mix_shared(ephemeral_, keys_.other());
        } else {
            mix_shared(keys_.own(), other_ephemeral_);
        }
        break;
    case Token::se:
        if (is_initiator) {
            mix_shared(keys_.own(), other_ephemeral_);
        } else {
            mix_shared(ephemeral_, keys_.other());
        }
        break;
    }
}

void NoiseKk::mix_ephemeral()
{
    PublicKey& key = writes_ ? ephemeral_public_ : other_ephemeral_;
    if (writes_) {
        key = public_key_of(ephemeral_);
        std::ranges::copy(key, buffer_.begin());
    } else {
        std::copy_n(buffer_.begin(), key_bytes, key.begin());
    }
    mix_hash(key);
    mix_key(key); // makes the first key unique if a pre-shared key is used
}

void NoiseKk::mix_shared(const Secret& own, const PublicKey& other)
{
    const auto shared = diffie_hellman(own, other);
    if (shared) {
        mix_key(shared->bytes());
    } else {
        is_refused_ = true;
    }
}

/// Seals or opens the payload.
NoiseKk::Progress NoiseKk::finish()
{
    const auto sealed = std::span{buffer_}.subspan(key_bytes, size_ - key_bytes);
    const Hash before = state_.hash;
    if (writes_) {
        seal(state_.key, state_.number++, before, sealed);
        mix_hash(sealed);
    } else {
        mix_hash(sealed);
        is_refused_ = !open(state_.key, state_.number++, before, sealed);
    }
    if (is_refused_) return refuse();
    is_under_way_ = false;
    ++message_;
    return Progress::done;
}

Bytes NoiseKk::payload() const
{
    base::ensure(!writes_ && !is_under_way_ && !is_refused_);
    return Bytes{buffer_}.subspan(key_bytes, size_ - key_bytes - tag_bytes);
}

NoiseKk::TransportKeys NoiseKk::split()
{
    base::ensure(message_ == messages.size());
    const Expanded outputs = expand(state_.chaining_key, {});
    Secret first = key_from(outputs[0]), second = key_from(outputs[1]);
    if (role_ == Role::initiator) return {std::move(first), std::move(second), state_.hash};
    return {std::move(second), std::move(first), state_.hash};
}

} // namespace hapnet::secure
