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

/// How much one direction holds at a time.
struct QueueLimits {
    /// 65 s of a 1 kHz stream, or 160 ms of 400 kHz.
    std::size_t datagrams_max = 65'536;
};

/// Memory for the bytes of the datagrams in flight, all of it reserved at construction: storing
/// never allocates, and what has never been used costs no memory either (the system gives pages
/// on first use). Three sizes of slots: for datagrams up to 256, 2048 and 65536 bytes, a quarter
/// as many of the second as of the first, and up to 128 of the last.
class Slab {
public:
    using Slot = std::uint32_t;
    static constexpr Slot no_slot = 0xffff'ffff;

    explicit Slab(QueueLimits limits);

    /// A copy of `bytes` (at most 65536) in the smallest free slot that holds them; nullopt when
    /// there is none.
    [[nodiscard]] std::optional<Slot> store(std::span<const std::byte> bytes);

    [[nodiscard]] std::span<std::byte> bytes(Slot slot);

    /// The slot is free from now on.
    void release(Slot slot);

    [[nodiscard]] std::size_t used() const { return used_; }

private:
    struct SizeClass {
        std::size_t slot_bytes = 0;
        Slot first = 0;
        std::unique_ptr<std::byte[]> memory; // NOLINT(*-avoid-c-arrays): not filled with zeros
        std::vector<Slot> free;
    };

    [[nodiscard]] SizeClass& class_of(Slot slot);

    std::array<SizeClass, 3> classes_;
    std::vector<std::uint32_t> lengths_; // by slot
    std::size_t used_ = 0;
};

} // namespace hapnet::emulator
