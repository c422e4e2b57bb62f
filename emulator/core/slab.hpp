// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::emulator {

/// Memory for the bytes of the datagrams in flight of all links that share it. All of it is
/// reserved at construction: storing never allocates, and memory that has never been used costs
/// nothing (the system provides pages on first use).
///
/// It is divided into blocks of 64 KiB. A block has slots of one size, the smallest size that holds
/// the datagram for which the block was taken. When its last slot is free, the block can be used
/// for any size again.
class Slab {
public:
    using Slot = std::uint32_t;
    static constexpr Slot no_slot = 0xffff'ffff;
    static constexpr std::size_t block_bytes = std::size_t{64} << 10;
    /// The limit keeps the numbers of slots within 32 bits.
    static constexpr std::size_t bytes_limit = std::size_t{256} << 30;

    /// Ensures that `bytes_max` is at least one block and at most `bytes_limit`. The remainder
    /// beyond whole blocks is not used.
    explicit Slab(std::size_t bytes_max);

    struct Stored {
        Slot slot = no_slot;
        std::span<std::byte> bytes; // the stored copy
        std::size_t slot_bytes = 0; // size of the slot that holds the copy
    };

    /// Stores a copy of `bytes` (at most 65536); nullopt when there is no room.
    [[nodiscard]] std::optional<Stored> store(std::span<const std::byte> bytes);

    /// Frees the slot. Returns the amount of memory that this frees.
    std::size_t release(Slot slot);

private:
    static constexpr std::array<std::uint32_t, 10> sizes{128,  256,  512,  1024,   1536,
                                                         2048, 4096, 8192, 16'384, 65'536};
    static constexpr auto capacities = [] { // slots in a block of each size
        std::array<std::uint32_t, sizes.size()> each{};
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            each[i] = static_cast<std::uint32_t>(block_bytes) / sizes[i];
        }
        return each;
    }();
    /// The number of slot numbers of a block. A block of the smallest size needs all of them.
    static constexpr std::uint32_t slots_max = block_bytes / sizes.front();
    static constexpr std::uint32_t none = 0xffff'ffff;

    /// A free slot holds the index of the next free slot of its block.
    using Index = std::uint16_t;
    static constexpr Index no_index = 0xffff;

    struct Block {
        std::uint32_t previous = none; // previous block of its size with room
        std::uint32_t next = none;     // next block of its size with room; if free: next free block
        Index used = 0;                // slots in use
        Index touched = 0;             // slots used at least once since the block was free
        Index free = no_index;         // first free slot among the touched ones
        std::uint8_t size = 0;         // index in `sizes`
    };

    [[nodiscard]] static std::uint8_t size_for(std::size_t bytes);
    [[nodiscard]] std::optional<std::uint32_t> block_with_room(std::uint8_t size);
    [[nodiscard]] Index take_index(Block& block, std::byte* memory);
    void open(std::uint32_t number);
    void close(std::uint32_t number);
    [[nodiscard]] std::byte* memory_of(std::uint32_t block) const
    {
        return memory_.get() + std::size_t{block} * block_bytes;
    }

    std::unique_ptr<std::byte[]> memory_; // NOLINT(*-avoid-c-arrays): not filled with zeros
    std::vector<Block> blocks_;
    std::array<std::uint32_t, sizes.size()> open_{}; // the first block of each size that has room
    std::uint32_t free_ = none;                      // first free block that was used before
    std::uint32_t touched_ = 0;                      // this block and all behind it were never used
};

} // namespace hapnet::emulator
