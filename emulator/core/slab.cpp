// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/slab.hpp"

#include "proto/base/ensure.hpp"

#include <cstring>

namespace hapnet::emulator {

Slab::Slab(std::size_t bytes_max)
{
    const std::size_t count = bytes_max / block_bytes;
    base::ensure(count > 0 && bytes_max <= bytes_limit);
    // NOLINTNEXTLINE(*-avoid-c-arrays)
    memory_ = std::make_unique_for_overwrite<std::byte[]>(count * block_bytes);
    blocks_.resize(count);
    open_.fill(none);
}

/// Returns the index of the smallest size that holds this number of bytes.
std::uint8_t Slab::size_for(std::size_t bytes)
{
    static constexpr auto by_units = [] {
        std::array<std::uint8_t, slots_max + 1> table{};
        std::uint8_t size = 0;
        for (std::size_t units = 0; units < table.size(); ++units) {
            if (units * sizes.front() > sizes[size]) ++size;
            table[units] = size;
        }
        return table;
    }();
    base::ensure(bytes <= block_bytes);
    return by_units[(bytes + sizes.front() - 1) / sizes.front()];
}

/// Returns a block with a free slot of this size. If none is available, it has slots of the
/// smallest larger size with a free slot; nullopt: there is no free slot of any size.
std::optional<std::uint32_t> Slab::block_with_room(std::uint8_t size)
{
    if (open_[size] != none) return open_[size];
    if (free_ == none && touched_ == blocks_.size()) {
        for (std::size_t larger = size + std::size_t{1}; larger < sizes.size(); ++larger) {
            if (open_[larger] != none) return open_[larger];
        }
        return std::nullopt;
    }
    const std::uint32_t number = free_ != none ? free_ : touched_++;
    if (number == free_) free_ = blocks_[number].next;
    blocks_[number] = Block{};
    blocks_[number].size = size;
    open(number);
    return number;
}

/// Adds the block to the list of those with room.
void Slab::open(std::uint32_t number)
{
    Block& block = blocks_[number];
    std::uint32_t& first = open_[block.size];
    block.previous = none;
    block.next = first;
    if (first != none) blocks_[first].previous = number;
    first = number;
}

/// Removes the block from that list: it has no room any more, or is free.
void Slab::close(std::uint32_t number)
{
    const Block& block = blocks_[number];
    if (block.next != none) blocks_[block.next].previous = block.previous;
    (block.previous != none ? blocks_[block.previous].next : open_[block.size]) = block.next;
}

Slab::Index Slab::take_index(Block& block, std::byte* memory)
{
    ++block.used;
    if (block.free == no_index) return block.touched++;
    const Index index = block.free;
    std::memcpy(&block.free, memory + std::size_t{index} * sizes[block.size], sizeof block.free);
    return index;
}

std::optional<Slab::Stored> Slab::store(std::span<const std::byte> bytes)
{
    const auto number = block_with_room(size_for(bytes.size()));
    if (!number) return std::nullopt;
    Block& block = blocks_[*number];
    std::byte* const memory = memory_of(*number);
    const Index index = take_index(block, memory);
    if (block.used == capacities[block.size]) close(*number);
    const std::size_t slot_bytes = sizes[block.size];
    std::byte* const place = memory + index * slot_bytes;
    if (!bytes.empty()) std::memcpy(place, bytes.data(), bytes.size());
    return Stored{*number * slots_max + index, {place, bytes.size()}, slot_bytes};
}

std::size_t Slab::release(Slot slot)
{
    const std::uint32_t number = slot / slots_max;
    base::ensure(number < touched_);
    Block& block = blocks_[number];
    const auto index = static_cast<Index>(slot % slots_max);
    base::ensure(block.used > 0 && index < block.touched);
    const std::size_t slot_bytes = sizes[block.size];
    if (block.used == capacities[block.size]) open(number);
    if (--block.used == 0) {
        close(number);
        block.next = free_;
        free_ = number;
        return slot_bytes;
    }
    std::memcpy(memory_of(number) + index * slot_bytes, &block.free, sizeof block.free);
    block.free = index;
    return slot_bytes;
}

} // namespace hapnet::emulator
