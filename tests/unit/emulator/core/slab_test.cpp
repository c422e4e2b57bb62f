// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/slab.hpp"

#include "proto/base/random.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::emulator {
namespace {

std::vector<std::byte> filled(std::size_t bytes, int value)
{
    return std::vector<std::byte>(bytes, static_cast<std::byte>(value));
}

TEST(Slab, KeepsACopyOfTheBytesUntilTheyAreReleased)
{
    Slab slab{Slab::block_bytes};
    auto bytes = filled(3, 7);
    const auto stored = slab.store(bytes);
    ASSERT_TRUE(stored);
    bytes = filled(3, 8);
    EXPECT_TRUE(std::ranges::equal(stored->bytes, filled(3, 7)));
    EXPECT_EQ(stored->slot_bytes, 128U);
}

TEST(Slab, SaysWhatADatagramTakesOfItsMemory)
{
    Slab slab{4 * Slab::block_bytes};
    for (const auto& [bytes, slot] : {std::pair{0U, 128U}, std::pair{144U, 256U},
                                      std::pair{1200U, 1536U}, std::pair{65'535U, 65'536U}}) {
        const auto stored = slab.store(filled(bytes, 1));
        EXPECT_EQ(stored->slot_bytes, slot);
        EXPECT_EQ(slab.release(stored->slot), slot);
    }
}

TEST(Slab, HoldsTheLargestDatagramAndTheEmptyOne)
{
    Slab slab{2 * Slab::block_bytes};
    const auto largest = slab.store(filled(65'535, 7));
    ASSERT_TRUE(largest);
    EXPECT_TRUE(std::ranges::equal(largest->bytes, filled(65'535, 7)));
    const auto empty = slab.store({});
    ASSERT_TRUE(empty);
    EXPECT_TRUE(empty->bytes.empty());
}

TEST(Slab, HoldsWhatItsBytesAllowWhateverTheSizeIs)
{
    struct Case {
        std::size_t bytes;
        std::size_t each; // slots of a block
    };
    for (const auto [bytes, each] : {Case{1, 512}, Case{128, 512}, Case{129, 256}, Case{256, 256},
                                     Case{1200, 42}, Case{1472, 42}, Case{1536, 42}, Case{1537, 32},
                                     Case{9000, 4}, Case{16'385, 1}, Case{65'536, 1}}) {
        Slab slab{16 * Slab::block_bytes};
        const auto datagram = filled(bytes, 1);
        for (std::size_t i = 0; i < 16 * each; ++i) ASSERT_TRUE(slab.store(datagram)) << bytes;
        EXPECT_FALSE(slab.store(datagram)) << bytes;
    }
}

TEST(Slab, TakesALargerSlotWhenNoBlockIsFreeAndNoneWhenAllAreUsed)
{
    Slab slab{2 * Slab::block_bytes};
    ASSERT_TRUE(slab.store(filled(1500, 1))); // one block: 41 slots are left
    for (int i = 0; i < 512 + 41; ++i) ASSERT_TRUE(slab.store(filled(100, 2))) << i;
    EXPECT_FALSE(slab.store(filled(100, 2)));
}

TEST(Slab, GivesABlockToAnotherSizeWhenItIsEmptyAgain)
{
    Slab slab{Slab::block_bytes};
    std::vector<Slab::Slot> slots;
    for (int i = 0; i < 512; ++i) slots.push_back(slab.store(filled(100, 1))->slot);
    EXPECT_FALSE(slab.store(filled(60'000, 2)));
    for (const Slab::Slot slot : slots) slab.release(slot);
    EXPECT_TRUE(slab.store(filled(60'000, 2)));
}

TEST(Slab, MixesNoBytesWhateverIsStoredAndReleased)
{
    struct Held {
        Slab::Stored stored;
        std::byte value{};
    };
    const auto chance = base::Seed{3}.stream("slab");
    Slab slab{24 * Slab::block_bytes};
    std::vector<Held> held;
    std::size_t refused = 0;
    for (std::uint64_t step = 0; step < 30'000; ++step) {
        if (!held.empty() && chance.below(100, step, 0) < 45) {
            const auto which = chance.below(static_cast<std::uint32_t>(held.size()), step, 1);
            const Held one = held[which];
            ASSERT_TRUE(std::ranges::all_of(one.stored.bytes,
                                            [&](std::byte byte) { return byte == one.value; }));
            slab.release(one.stored.slot);
            held[which] = held.back();
            held.pop_back();
            continue;
        }
        const auto size = chance.below(20, step, 2) == 0 ? chance.below(65'537, step, 3)
                                                         : chance.below(1600, step, 3);
        const auto bytes = filled(static_cast<std::size_t>(size), static_cast<int>(step % 251));
        if (const auto stored = slab.store(bytes)) {
            held.push_back({*stored, static_cast<std::byte>(step % 251)});
        } else {
            ++refused;
        }
    }
    EXPECT_GT(refused, 100U);
    for (const Held& one : held) slab.release(one.stored.slot);
    for (int i = 0; i < 24; ++i) EXPECT_TRUE(slab.store(filled(65'536, 0))) << i; // nothing is lost
}

} // namespace
} // namespace hapnet::emulator
