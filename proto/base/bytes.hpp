// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace hapnet::base {

/// Returns the number whose bytes in this machine's memory are the little-endian bytes of `value`.
/// The function is its own inverse.
template <std::unsigned_integral T>
[[nodiscard]] constexpr T in_little_endian(T value)
{
    if constexpr (std::endian::native == std::endian::little) {
        return value;
    } else {
        T swapped = 0;
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            swapped = static_cast<T>(swapped << 8 | ((value >> (8 * i)) & 0xffU));
        }
        return swapped;
    }
}

/// Reads little-endian fields one after another. The reader remembers a read beyond the end and
/// does not report it at each field: read all fields, then call complete() once.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes) : left_{bytes} {}

    [[nodiscard]] std::uint8_t u8() { return unsigned_of<std::uint8_t>(); }
    [[nodiscard]] std::uint16_t u16() { return unsigned_of<std::uint16_t>(); }
    [[nodiscard]] std::uint32_t u32() { return unsigned_of<std::uint32_t>(); }
    [[nodiscard]] std::uint64_t u64() { return unsigned_of<std::uint64_t>(); }
    [[nodiscard]] std::int64_t i64() { return static_cast<std::int64_t>(u64()); }
    [[nodiscard]] float f32() { return std::bit_cast<float>(u32()); }
    [[nodiscard]] double f64() { return std::bit_cast<double>(u64()); }

    /// Returns the next `count` bytes, or an empty span when fewer are left.
    [[nodiscard]] std::span<const std::byte> raw(std::size_t count)
    {
        if (!has(count)) return {};
        const auto taken = left_.first(count);
        left_ = left_.subspan(count);
        return taken;
    }

    /// True if at least `count` bytes are left.
    [[nodiscard]] bool holds(std::size_t count) const { return left_.size() >= count; }
    /// True if no read has gone beyond the end.
    [[nodiscard]] bool ok() const { return !short_; }
    /// True if no read has gone beyond the end and no byte is left over.
    [[nodiscard]] bool complete() const { return !short_ && left_.empty(); }

private:
    /// Returns true if `count` bytes are left. After the first false, the rest is discarded.
    [[nodiscard]] bool has(std::size_t count)
    {
        if (left_.size() >= count) [[likely]]
            return true;
        short_ = true;
        left_ = {};
        return false;
    }

    template <std::unsigned_integral T>
    [[nodiscard]] T unsigned_of()
    {
        if (!has(sizeof(T))) return 0;
        std::array<std::byte, sizeof(T)> bytes; // NOLINT(*-member-init): filled in the next line
        std::memcpy(bytes.data(), left_.data(), sizeof(T));
        left_ = left_.subspan(sizeof(T));
        return in_little_endian(std::bit_cast<T>(bytes));
    }

    std::span<const std::byte> left_;
    bool short_ = false;
};

/// Writes little-endian fields one after another into a buffer, which must be large enough.
class ByteWriter {
public:
    explicit ByteWriter(std::span<std::byte> buffer) : buffer_{buffer}, left_{buffer} {}

    void u8(std::uint8_t value) { put(value); }
    void u16(std::uint16_t value) { put(value); }
    void u32(std::uint32_t value) { put(value); }
    void u64(std::uint64_t value) { put(value); }
    void i64(std::int64_t value) { put(static_cast<std::uint64_t>(value)); }
    void f32(float value) { put(std::bit_cast<std::uint32_t>(value)); }
    void f64(double value) { put(std::bit_cast<std::uint64_t>(value)); }
    void raw(std::span<const std::byte> bytes)
    {
        ensure(left_.size() >= bytes.size());
        if (!bytes.empty()) std::memcpy(left_.data(), bytes.data(), bytes.size());
        left_ = left_.subspan(bytes.size());
    }

    [[nodiscard]] std::span<const std::byte> written() const
    {
        return buffer_.first(buffer_.size() - left_.size());
    }

private:
    template <std::unsigned_integral T>
    void put(T value)
    {
        ensure(left_.size() >= sizeof(T));
        const T ordered = in_little_endian(value);
        std::memcpy(left_.data(), &ordered, sizeof(T));
        left_ = left_.subspan(sizeof(T));
    }

    std::span<std::byte> buffer_;
    std::span<std::byte> left_;
};

} // namespace hapnet::base
