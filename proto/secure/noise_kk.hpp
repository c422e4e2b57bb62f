// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/secure/primitives.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::secure {

/// The keys that one side has before a handshake begins.
class StaticKeys {
public:
    /// Returns nullopt if no secret can be shared with that public key.
    [[nodiscard]] static std::optional<StaticKeys> from(Secret own, const PublicKey& other,
                                                        Secret shared);

    [[nodiscard]] const Secret& own() const { return own_; }
    [[nodiscard]] const PublicKey& own_public() const { return own_public_; }
    [[nodiscard]] const PublicKey& other() const { return other_; }
    [[nodiscard]] const Secret& pre_shared() const { return pre_shared_; }
    /// False if the circle has no pre-shared key. Handshakes use zeros then.
    [[nodiscard]] bool has_pre_shared() const { return !is_zero(pre_shared_.bytes()); }
    /// Returns the Diffie-Hellman secret of the two static keys. It is computed once, not in every
    /// handshake.
    [[nodiscard]] const Secret& common() const { return common_; }

private:
    StaticKeys(Secret own, const PublicKey& other, Secret shared, Secret common)
        : own_{std::move(own)},
          own_public_{public_key_of(own_)},
          other_{other},
          pre_shared_{std::move(shared)},
          common_{std::move(common)}
    {}

    Secret own_;
    PublicKey own_public_;
    PublicKey other_;
    Secret pre_shared_;
    Secret common_;
};

/// The role in a handshake. The initiator sends the first message.
enum class Role : std::uint8_t { initiator, responder };

/// One side's part in a handshake by the Noise protocol Noise_KKpsk0_25519_ChaChaPoly_BLAKE2b
/// (noiseprotocol.org, revision 34):
///
///     -> s   <- s   ...   -> psk, e, es, ss   <- e, ee, se
///
/// Two messages. Both sides prove that they hold their private key and the pre-shared key; what is
/// sealed with the keys that come out stays secret when those become known later. Begin a message
/// with write() or read(), then step() until it is done: a step takes one multiplication on the
/// curve at most (some 50 us), so that nothing else has to wait for a handshake. A message that is
/// refused leaves the handshake as it was before read(), so the genuine message may still come.
/// Reads no clock and draws nothing at random.
class NoiseKk {
public:
    static constexpr std::size_t payload_bytes_max = 32;
    static constexpr std::size_t message_bytes_max = key_bytes + payload_bytes_max + tag_bytes;

    /// `prologue` is data that must be equal on both sides. `keys` must outlive this. `ephemeral`
    /// must be drawn for this handshake only.
    NoiseKk(Role role, const StaticKeys& keys, Bytes prologue, Secret ephemeral);

    /// Begins to write this side's next message.
    void write(Bytes payload);
    /// Begins to read the other side's next message.
    void read(Bytes message);

    enum class Progress : std::uint8_t { working, done, refused };
    /// Continues with the message. Returns `refused` if the other side has not sent it for this
    /// handshake.
    [[nodiscard]] Progress step();

    /// Returns the message, after write() is done.
    [[nodiscard]] Bytes message() const { return Bytes{buffer_}.first(size_); }
    /// Returns the payload of the message, after read() is done.
    [[nodiscard]] Bytes payload() const;

    /// The keys for messages after the handshake.
    struct TransportKeys {
        Secret to_other, from_other;
        Hash handshake{}; // hash of the handshake, equal on both sides only
    };
    [[nodiscard]] TransportKeys split();

private:
    enum class Token : std::uint8_t { psk, e, es, ss, ee, se };
    struct Tokens {
        std::array<Token, 4> all{};
        std::size_t count = 0;
    };
    static constexpr std::array<Tokens, 2> messages{
        Tokens{{Token::psk, Token::e, Token::es, Token::ss}, 4},
        Tokens{{Token::e, Token::ee, Token::se}, 3}};

    /// The SymmetricState of Noise (section 5.2).
    struct Symmetric {
        SecretHash chaining_key;
        Hash hash{};
        Secret key; // key of the cipher
        std::uint64_t number = 0;

        [[nodiscard]] Symmetric copy() const
        {
            return {chaining_key.copy(), hash, key.copy(), number};
        }
    };

    void mix_hash(Bytes data);
    void mix_key(Bytes input);
    void mix_key_and_hash(Bytes input);
    void begin(std::size_t size, bool writes);
    void mix_ephemeral();
    void mix_shared(const Secret& own, const PublicKey& other);
    [[nodiscard]] bool multiplies(Token token) const;
    void apply(Token token);
    [[nodiscard]] Progress finish();
    [[nodiscard]] Progress refuse();

    Role role_;
    const StaticKeys& keys_;
    Secret ephemeral_;
    PublicKey ephemeral_public_{};
    PublicKey other_ephemeral_{};
    Symmetric state_;
    Symmetric before_; // state before the message in progress

    std::size_t message_ = 0; // number of the message, 0 or 1; 2: all done
    std::size_t token_ = 0;
    bool writes_ = false;
    bool is_under_way_ = false;
    bool is_refused_ = false;
    std::array<std::byte, message_bytes_max> buffer_{};
    std::size_t size_ = 0;
};

} // namespace hapnet::secure
