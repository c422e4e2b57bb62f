// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/transport.hpp"

#include "proto/base/ensure.hpp"

namespace hapnet::secure {

namespace {

/// The kinds share a key and no number.
std::uint64_t nonce_number(Kind kind, std::uint32_t number)
{
    return static_cast<std::uint64_t>(kind) << 32 | number;
}

} // namespace

void Sealer::seal(Kind kind, std::uint32_t number, Bytes associated, std::span<std::byte> room)
{
    base::ensure(may_seal(kind, number));
    next_[static_cast<std::size_t>(kind)] = std::uint64_t{number} + 1;
    secure::seal(key_, nonce_number(kind, number), associated, room);
}

Opener::Outcome Opener::open(Kind kind, std::uint32_t number, Bytes associated,
                             std::span<std::byte> room)
{
    const bool is_state = kind == Kind::state;
    if (!(is_state ? states_.is_fresh(number) : controls_.is_fresh(number)))
        return Outcome::replayed;
    if (room.size() < tag_bytes || number > Sealer::number_max ||
        !secure::open(key_, nonce_number(kind, number), associated, room))
        return Outcome::forged;
    const bool is_newest = is_state ? states_.note(number) : controls_.note(number);
    return is_newest ? Outcome::opened_newest : Outcome::opened;
}

} // namespace hapnet::secure
