// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/transport.hpp"

#include "tests/unit/proto/secure/hex.hpp"

#include <gtest/gtest.h>
#include <type_traits>

namespace hapnet::secure {

namespace {

using Outcome = Opener::Outcome;

Secret a_key()
{
    return secret_from_hex("1c9240a5eb55d38af333888604f6b5f0473917c1402b80099dca5cbc207075c0");
}

Text sealed(Sealer& sealer, Kind kind, std::uint32_t number)
{
    Text room(8 + tag_bytes);
    sealer.seal(kind, number, {}, room);
    return room;
}

} // namespace

static_assert(!std::is_copy_constructible_v<Sealer>);

TEST(Opener, OpensEachMessageOnceInAnyOrder)
{
    Sealer sealer{a_key()};
    Opener opener{a_key()};
    Text first = sealed(sealer, Kind::state, 1), second = sealed(sealer, Kind::state, 2);
    Text again = first;
    EXPECT_EQ(opener.open(Kind::state, 2, {}, second), Outcome::opened_newest);
    EXPECT_EQ(opener.open(Kind::state, 1, {}, first), Outcome::opened);
    EXPECT_EQ(opener.open(Kind::state, 1, {}, again), Outcome::replayed);
}

TEST(Opener, KeepsTheKindsApart)
{
    Sealer sealer{a_key()};
    Opener opener{a_key()};
    Text state = sealed(sealer, Kind::state, 5), control = sealed(sealer, Kind::control, 5);
    Text as_control = state;
    EXPECT_EQ(opener.open(Kind::control, 5, {}, as_control), Outcome::forged);
    EXPECT_EQ(opener.open(Kind::state, 5, {}, state), Outcome::opened_newest);
    EXPECT_EQ(opener.open(Kind::control, 5, {}, control), Outcome::opened_newest);
}

TEST(Opener, IsNotMovedByAForgedMessage)
{
    Sealer sealer{a_key()};
    Opener opener{a_key()};
    Text genuine = sealed(sealer, Kind::state, 1);
    Text forged(8 + tag_bytes);
    EXPECT_EQ(opener.open(Kind::state, 1'000'000, {}, forged), Outcome::forged);
    Text too_short(tag_bytes - 1);
    EXPECT_EQ(opener.open(Kind::state, 1, {}, too_short), Outcome::forged);
    EXPECT_EQ(opener.open(Kind::state, 1, {}, genuine), Outcome::opened_newest);
}

TEST(Sealer, EndsTheProgramRatherThanUseANumberTwice)
{
    Sealer sealer{a_key()};
    Text room(tag_bytes);
    sealer.seal(Kind::state, 7, {}, room);
    sealer.seal(Kind::control, 7, {}, room); // a kind of its own
    sealer.seal(Kind::state, 8, {}, room);
    EXPECT_DEATH(sealer.seal(Kind::state, 8, {}, room), "");
    EXPECT_DEATH(sealer.seal(Kind::state, 7, {}, room), "");
    EXPECT_DEATH(sealer.seal(Kind::state, 0x8000'0000, {}, room), "");
}

} // namespace hapnet::secure
