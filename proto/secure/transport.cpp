// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/transport.hpp"

#include "proto/base/ensure.hpp"

namespace hapnet::secure {

namespace {

/// Returns the number in the nonce. The kinds share a key, but no number.
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
    const auto open_once = [&](auto& numbers) {
        if (numbers.find(number) != base::Seen::no) return Outcome::replayed;
        if (room.size() < tag_bytes || number > Sealer::number_max ||
            !secure::open(key_, nonce_number(kind, number), associated, room))
            return Outcome::forged;
        // The number is added only now. Otherwise one forged message could exclude all later ones.
        numbers.add(number);
        return numbers.highest() == number ? Outcome::opened_newest : Outcome::opened;
    };
    return kind == Kind::state ? open_once(states_) : open_once(controls_);
}

} // namespace hapnet::secure
