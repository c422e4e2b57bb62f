// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hid/descriptor.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::device::hid {

// A report's data are counted without its ID. Bits are numbered from the least significant one of
// the first byte: USB Device Class Definition for HID 1.11, section 8.

/// The field's value; nullopt where the data end before it or the value lies outside its logical
/// range, by which a device says that it has none.
[[nodiscard]] std::optional<std::int64_t> unpack(const Field& field,
                                                 std::span<const std::byte> data);

/// Writes a value of the field's logical range into data that reach as far.
void pack(const Field& field, std::int64_t value, std::span<std::byte> data);

/// Writes the field's bits whatever its logical range: for switches, whose range many devices
/// give wrongly.
void pack_bits(const Field& field, std::uint32_t bits, std::span<std::byte> data);

/// The whole logical value nearest to a share of full scale: 0 is 0, 1 the range's upper end, and
/// -1 its lower end or the upper one's opposite, whichever is nearer to 0. A share beyond -1 or 1
/// is limited to these ends; one that is not finite gives 0.
[[nodiscard]] std::int64_t scaled(const Field& field, double share);

/// Returns the position of a value in the field's logical range: -1 at its lower end, 1 at its
/// upper.
[[nodiscard]] double share_of(const Field& field, std::int64_t value);

} // namespace hapnet::device::hid
