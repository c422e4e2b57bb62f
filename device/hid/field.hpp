// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hid/descriptor.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::device::hid {

// Offsets in a report's data do not include its ID. Bits are numbered from the least significant
// one of the first byte: USB Device Class Definition for HID 1.11, section 8.

/// Returns the field's value; nullopt if the data end before the field, or if the value lies
/// outside its logical range, which means that the device has no value.
[[nodiscard]] std::optional<std::int64_t> unpack(const Field& field,
                                                 std::span<const std::byte> data);

/// Writes a value of the field's logical range into data that are long enough.
void pack(const Field& field, std::int64_t value, std::span<std::byte> data);

/// Writes the field's bits whatever its logical range is. For switches, whose range is wrong in
/// many devices.
void pack_bits(const Field& field, std::uint32_t bits, std::span<std::byte> data);

/// Returns the integer logical value nearest to a share of full scale. 0 gives 0, 1 gives the upper
/// end of the range, and -1 gives the lower end or the negative of the upper end, whichever is
/// nearer to 0. A share beyond -1 or 1 is limited to these ends. A share that is not finite gives
/// 0.
[[nodiscard]] std::int64_t scaled(const Field& field, double share);

/// Returns the position of a value in the field's logical range: -1 at its lower end, 1 at its
/// upper end.
[[nodiscard]] double share_of(const Field& field, std::int64_t value);

} // namespace hapnet::device::hid
