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
    for (std::size_t i = 0; i < classes_.size(); ++i) {
        SizeClass& size_class = classes_[i];
        size_class.slot_bytes = sizes[i];
        size_class.first = next;
        // NOLINTNEXTLINE(*-avoid-c-arrays)
        size_class.memory = std::make_unique_for_overwrite<std::byte[]>(sizes[i] * counts[i]);
        next += static_cast<Slot>(counts[i]);
        // The lowest on top: few datagrams in flight stay in few pages.
        for (Slot slot = next; slot > size_class.first; --slot) size_class.free.push_back(slot - 1);
    }
    lengths_.resize(next);
}

std::optional<Slab::Slot> Slab::store(std::span<const std::byte> bytes)
{
    for (SizeClass& size_class : classes_) {
        if (bytes.size() > size_class.slot_bytes || size_class.free.empty()) continue;
        const Slot slot = size_class.free.back();
        size_class.free.pop_back();
        lengths_[slot] = static_cast<std::uint32_t>(bytes.size());
        const auto place = (slot - size_class.first) * size_class.slot_bytes;
        if (!bytes.empty())
            std::memcpy(size_class.memory.get() + place, bytes.data(), bytes.size());
        ++used_;
        return slot;
    }
    return std::nullopt;
}

std::span<std::byte> Slab::bytes(Slot slot)
{
    SizeClass& size_class = class_of(slot);
    return {size_class.memory.get() + (slot - size_class.first) * size_class.slot_bytes,
            lengths_[slot]};
}

void Slab::release(Slot slot)
{
    class_of(slot).free.push_back(slot);
    --used_;
}

Slab::SizeClass& Slab::class_of(Slot slot)
{
    base::ensure(slot < lengths_.size());
    if (slot >= classes_[2].first) return classes_[2];
    return slot >= classes_[1].first ? classes_[1] : classes_[0];
}

} // namespace hapnet::emulator
