// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/secure/primitives.hpp"
#include "proto/secure/transport.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::secure {

// The bytes of sealed messages and of handshakes. docs/formats/sealed.md is the specification.
// Numbers are little-endian. Each datagram begins with the magic number and the version of the
// plain messages, so that every version recognises other versions.

inline constexpr std::uint16_t magic = 0x4e48; // "HN"
inline constexpr std::uint8_t version = 2;

/// A bit in byte 3, the type. A sealed message has the type of its plain message with this bit set.
inline constexpr std::uint8_t sealed_bit = 0x80;
enum class FrameType : std::uint8_t {
    hello = 0x81,
    state = 0x82,
    bye = 0x83,
    initiation = 0x88,
    response = 0x89,
    cookie = 0x8a,
};
/// Returns the type of a sealed message or of a handshake; nullopt for anything else, including
/// plain messages.
[[nodiscard]] std::optional<FrameType> frame_type_of(Bytes datagram);

/// An index identifies a key or an unfinished handshake to the side that chose it.
using KeyIndex = std::uint32_t;

// --- sealed messages ---

/// The number of bytes that sealing adds. A state gets only the tag, because its sequence number is
/// the number of the seal. Other messages get a number and the tag.
inline constexpr std::size_t state_overhead = tag_bytes;
inline constexpr std::size_t control_overhead = 4 + tag_bytes;
/// The number of bytes of a state that stay readable: magic, version, type, key, sequence, time of
/// sending.
inline constexpr std::size_t state_head_bytes = 20;
inline constexpr std::size_t control_head_bytes = 12;
/// The length of a plain hello without content. A side that has nothing else to send seals it to
/// show that it has the key.
inline constexpr std::size_t empty_bytes = 8;

/// Seals a plain message in place; `room` must have `control_overhead` more bytes. `number` is the
/// number of the seal for hello and bye. Returns the size; nullopt if the bytes are not a message
/// of this protocol.
[[nodiscard]] std::optional<std::size_t> seal_frame(std::span<std::byte> room, std::size_t size,
                                                    KeyIndex key, std::uint32_t number,
                                                    Sealer& sealer);

/// Returns the key that a sealed message names; nullopt for other frames and for frames that are
/// too short.
[[nodiscard]] std::optional<KeyIndex> key_of(Bytes datagram);

/// The result of opening a sealed message in place.
struct OpenedFrame {
    Opener::Outcome outcome = Opener::Outcome::forged;
    bool is_state = false;
    std::size_t size = 0; // length of the opened plain message, whose session number is 0
};
[[nodiscard]] OpenedFrame open_frame(std::span<std::byte> datagram, Opener& opener);

// --- handshakes ---

/// The two sides of a handshake.
struct Ends {
    std::uint8_t from = 0, to = 0;

    friend bool operator==(const Ends&, const Ends&) = default;
};

inline constexpr std::size_t initiation_payload_bytes = 16;
inline constexpr std::size_t response_payload_bytes = 4;
inline constexpr std::size_t initiation_noise_bytes =
    key_bytes + initiation_payload_bytes + tag_bytes;
inline constexpr std::size_t response_noise_bytes = key_bytes + response_payload_bytes + tag_bytes;
inline constexpr std::size_t initiation_bytes = 108;
inline constexpr std::size_t response_bytes = 96;
inline constexpr std::size_t cookie_bytes = 64;

/// The two MACs at the end of an initiation or response, and the bytes that each of them covers.
struct Macs {
    Bytes covered_by_mac1, mac1, covered_by_mac2, mac2;
};

/// The first message of a handshake, with the fields that an answer needs.
struct Initiation {
    KeyIndex sender{};
    Ends ends;
    Bytes noise;
    Macs macs;
};
[[nodiscard]] std::optional<Initiation> read_initiation(Bytes datagram);

struct Response {
    KeyIndex receiver{}, sender{};
    Bytes noise;
    Macs macs;
};
[[nodiscard]] std::optional<Response> read_response(Bytes datagram);

struct CookieReply {
    KeyIndex receiver{};
    WideNonce nonce{};
    Bytes sealed; // a cookie and its tag
};
[[nodiscard]] std::optional<CookieReply> read_cookie_reply(Bytes datagram);

/// The bytes of one of the three handshake messages, or of a confirmation.
class HandshakeFrame {
public:
    [[nodiscard]] Bytes bytes() const { return Bytes{bytes_}.first(size_); }

    [[nodiscard]] static HandshakeFrame initiation(KeyIndex sender, Ends ends, Bytes noise);
    [[nodiscard]] static HandshakeFrame response(KeyIndex receiver, KeyIndex sender, Bytes noise);
    [[nodiscard]] static HandshakeFrame cookie(KeyIndex receiver, const WideNonce& nonce,
                                               Bytes sealed);
    /// Returns a sealed hello without content.
    [[nodiscard]] static HandshakeFrame confirmation(Bytes sealed);
    /// Sets the two MACs of an initiation or response, which are zeros before. They prove that the
    /// sender knows its receiver's key, and that the sender can be reached at its address.
    void set_macs(Bytes key_of_mac1, const std::optional<Mac>& cookie);
    [[nodiscard]] Bytes mac1() const;

private:
    std::array<std::byte, initiation_bytes> bytes_{};
    std::size_t size_ = 0;
};

} // namespace hapnet::secure
