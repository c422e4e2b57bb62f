// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/slab.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cstring>

namespace hapnet::emulator {

Slab::Slab(QueueLimits limits)
{
    const std::array sizes{std::size_t{256}, std::size_t{2048}, std::size_t{65'536}};
    const std::array counts{limits.datagrams_max, (limits.datagrams_max + 3) / 4,
                            std::min(limits.datagrams_max, std::size_t{128})};
    Slot next = 0;
    for (std::size_t i = 0; i < shelves_.size(); ++i) {
        Shelf& shelf = shelves_[i];
        shelf.slot_bytes = sizes[i];
        shelf.first = next;
        // NOLINTNEXTLINE(*-avoid-c-arrays)
        shelf.memory = std::make_unique_for_overwrite<std::byte[]>(sizes[i] * counts[i]);
        next += static_cast<Slot>(counts[i]);
        // The lowest on top: few datagrams in flight stay in few pages.
        for (Slot slot = next; slot > shelf.first; --slot) shelf.free.push_back(slot - 1);
    }
    lengths_.resize(next);
}

std::optional<Slab::Slot> Slab::store(std::span<const std::byte> bytes)
{
    for (Shelf& shelf : shelves_) {
        if (bytes.size() > shelf.slot_bytes || shelf.free.empty()) continue;
        const Slot slot = shelf.free.back();
        shelf.free.pop_back();
        lengths_[slot] = static_cast<std::uint32_t>(bytes.size());
        const auto place = (slot - shelf.first) * shelf.slot_bytes;
        if (!bytes.empty()) std::memcpy(shelf.memory.get() + place, bytes.data(), bytes.size());
        ++used_;
        return slot;
    }
    return std::nullopt;
}

std::span<std::byte> Slab::bytes(Slot slot)
{
    Shelf& shelf = shelf_of(slot);
    return {shelf.memory.get() + (slot - shelf.first) * shelf.slot_bytes, lengths_[slot]};
}

void Slab::release(Slot slot)
{
    shelf_of(slot).free.push_back(slot);
    --used_;
}

Slab::Shelf& Slab::shelf_of(Slot slot)
{
    base::ensure(slot < lengths_.size());
    if (slot >= shelves_[2].first) return shelves_[2];
    return slot >= shelves_[1].first ? shelves_[1] : shelves_[0];
}

} // namespace hapnet::emulator
