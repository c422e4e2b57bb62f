// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/frames.hpp"

#include "proto/base/bytes.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cstring>

namespace hapnet::secure {

namespace {

using base::ByteReader;
using base::ByteWriter;

constexpr std::size_t mac_bytes = sizeof(Mac);
constexpr std::size_t key_place = 4, sequence_place = 8;
constexpr std::size_t initiation_head = 12, response_head = 12;

static_assert(initiation_bytes ==
              initiation_head + key_bytes + initiation_payload_bytes + tag_bytes + 2 * mac_bytes);
static_assert(response_bytes ==
              response_head + key_bytes + response_payload_bytes + tag_bytes + 2 * mac_bytes);
static_assert(cookie_bytes == 8 + wide_nonce_bytes + mac_bytes + tag_bytes);

std::uint32_t u32_at(Bytes bytes, std::size_t place)
{
    return ByteReader{bytes.subspan(place, 4)}.u32();
}

void put_u32(std::span<std::byte> bytes, std::size_t place, std::uint32_t value)
{
    ByteWriter{bytes.subspan(place, 4)}.u32(value);
}

void put_head(ByteWriter& out, FrameType type)
{
    out.u16(magic);
    out.u8(version);
    out.u8(static_cast<std::uint8_t>(type));
}

Macs macs_of(Bytes datagram)
{
    const std::size_t first = datagram.size() - 2 * mac_bytes;
    return {datagram.first(first), datagram.subspan(first, mac_bytes),
            datagram.first(first + mac_bytes), datagram.last(mac_bytes)};
}

bool is_plain_type(std::byte type) { return type >= std::byte{1} && type <= std::byte{3}; }
constexpr std::byte plain_state{2};

} // namespace

std::optional<FrameType> frame_type_of(Bytes datagram)
{
    if (datagram.size() < 4) return std::nullopt;
    ByteReader in{datagram};
    if (in.u16() != magic || in.u8() != version) return std::nullopt;
    const auto type = static_cast<FrameType>(in.u8());
    switch (type) {
    case FrameType::hello:
    case FrameType::state:
    case FrameType::bye:
    case FrameType::initiation:
    case FrameType::response:
    case FrameType::cookie: return type;
    }
    return std::nullopt;
}

std::optional<std::size_t> seal_frame(std::span<std::byte> room, std::size_t size, KeyIndex key,
                                      std::uint32_t number, Sealer& sealer)
{
    base::ensure(room.size() >= size + control_overhead);
    constexpr std::size_t head = 8;
    if (size < head || !is_plain_type(room[3])) return std::nullopt;
    const bool is_state = room[3] == plain_state;
    if (is_state && size < state_head_bytes) return std::nullopt;
    room[3] |= std::byte{sealed_bit};
    put_u32(room, key_place, key);
    if (is_state) {
        sealer.seal(Kind::state, u32_at(room, sequence_place), room.first(state_head_bytes),
                    room.subspan(state_head_bytes, size - state_head_bytes + tag_bytes));
        return size + state_overhead;
    }
    std::memmove(&room[control_head_bytes], &room[head], size - head);
    put_u32(room, head, number);
    sealer.seal(Kind::control, number, room.first(control_head_bytes),
                room.subspan(control_head_bytes, size - head + tag_bytes));
    return size + control_overhead;
}

std::optional<KeyIndex> key_of(Bytes datagram)
{
    const auto type = frame_type_of(datagram);
    if (!type) return std::nullopt;
    const bool is_state = type == FrameType::state;
    if (!is_state && type != FrameType::hello && type != FrameType::bye) return std::nullopt;
    const std::size_t least = (is_state ? state_head_bytes : control_head_bytes) + tag_bytes;
    if (datagram.size() < least) return std::nullopt;
    return u32_at(datagram, key_place);
}

OpenedFrame open_frame(std::span<std::byte> datagram, Opener& opener)
{
    base::ensure(key_of(datagram).has_value());
    const bool is_state = frame_type_of(datagram) == FrameType::state;
    const std::size_t head = is_state ? state_head_bytes : control_head_bytes;
    OpenedFrame opened{.is_state = is_state};
    opened.outcome =
        opener.open(is_state ? Kind::state : Kind::control, u32_at(datagram, sequence_place),
                    datagram.first(head), datagram.subspan(head));
    if (opened.outcome != Opener::Outcome::opened &&
        opened.outcome != Opener::Outcome::opened_newest)
        return opened;
    datagram[3] &= ~std::byte{sealed_bit};
    put_u32(datagram, key_place, 0);
    opened.size = datagram.size() - (is_state ? state_overhead : control_overhead);
    constexpr std::size_t plain_head = 8;
    if (!is_state && opened.size > plain_head)
        std::memmove(&datagram[plain_head], &datagram[head], opened.size - plain_head);
    return opened;
}

std::optional<Initiation> read_initiation(Bytes datagram)
{
    if (datagram.size() != initiation_bytes || frame_type_of(datagram) != FrameType::initiation)
        return std::nullopt;
    ByteReader in{datagram.subspan(4)};
    Initiation initiation;
    initiation.sender = in.u32();
    initiation.ends.from = in.u8();
    initiation.ends.to = in.u8();
    if (in.u16() != 0) return std::nullopt;
    initiation.noise = in.raw(initiation_noise_bytes);
    initiation.macs = macs_of(datagram);
    return initiation;
}

std::optional<Response> read_response(Bytes datagram)
{
    if (datagram.size() != response_bytes || frame_type_of(datagram) != FrameType::response)
        return std::nullopt;
    ByteReader in{datagram.subspan(4)};
    Response response;
    response.receiver = in.u32();
    response.sender = in.u32();
    response.noise = in.raw(response_noise_bytes);
    response.macs = macs_of(datagram);
    return response;
}

std::optional<CookieReply> read_cookie_reply(Bytes datagram)
{
    if (datagram.size() != cookie_bytes || frame_type_of(datagram) != FrameType::cookie)
        return std::nullopt;
    ByteReader in{datagram.subspan(4)};
    CookieReply reply;
    reply.receiver = in.u32();
    std::ranges::copy(in.raw(wide_nonce_bytes), reply.nonce.begin());
    reply.sealed = in.raw(mac_bytes + tag_bytes);
    return reply;
}

HandshakeFrame HandshakeFrame::initiation(KeyIndex sender, Ends ends, Bytes noise)
{
    base::ensure(noise.size() == key_bytes + initiation_payload_bytes + tag_bytes);
    HandshakeFrame frame;
    ByteWriter out{frame.bytes_};
    put_head(out, FrameType::initiation);
    out.u32(sender);
    out.u8(ends.from);
    out.u8(ends.to);
    out.u16(0);
    out.raw(noise);
    frame.size_ = initiation_bytes;
    return frame;
}

HandshakeFrame HandshakeFrame::response(KeyIndex receiver, KeyIndex sender, Bytes noise)
{
    base::ensure(noise.size() == key_bytes + response_payload_bytes + tag_bytes);
    HandshakeFrame frame;
    ByteWriter out{frame.bytes_};
    put_head(out, FrameType::response);
    out.u32(receiver);
    out.u32(sender);
    out.raw(noise);
    frame.size_ = response_bytes;
    return frame;
}

HandshakeFrame HandshakeFrame::cookie(KeyIndex receiver, const WideNonce& nonce, Bytes sealed)
{
    base::ensure(sealed.size() == mac_bytes + tag_bytes);
    HandshakeFrame frame;
    ByteWriter out{frame.bytes_};
    put_head(out, FrameType::cookie);
    out.u32(receiver);
    out.raw(nonce);
    out.raw(sealed);
    frame.size_ = cookie_bytes;
    return frame;
}

HandshakeFrame HandshakeFrame::confirmation(Bytes sealed)
{
    HandshakeFrame frame;
    base::ensure(sealed.size() <= frame.bytes_.size());
    std::ranges::copy(sealed, frame.bytes_.begin());
    frame.size_ = sealed.size();
    return frame;
}

void HandshakeFrame::set_macs(Bytes key_of_mac1, const std::optional<Mac>& cookie)
{
    const std::span<std::byte> all = std::span{bytes_}.first(size_);
    const std::size_t first = size_ - 2 * mac_bytes;
    std::ranges::copy(keyed_hash(key_of_mac1, all.first(first)), all.subspan(first).begin());
    if (!cookie) return;
    const Mac mac2 = keyed_hash(*cookie, all.first(first + mac_bytes));
    std::ranges::copy(mac2, all.last(mac_bytes).begin());
}

Bytes HandshakeFrame::mac1() const { return bytes().subspan(size_ - 2 * mac_bytes, mac_bytes); }

} // namespace hapnet::secure
