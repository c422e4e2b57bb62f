// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/record/rows.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace hapnet::record {

/// Every row takes this many bytes, so that the n-th row is found without reading those before.
inline constexpr std::size_t row_bytes = 216;

using RowBytes = std::array<std::byte, row_bytes>;

/// One byte for the kind of the row, its fields (fields.hpp) little-endian and unaligned, then
/// zeros. A MessageRow's size must be within its bounds; times beyond 36 years are written, but
/// decode() refuses them.
[[nodiscard]] RowBytes encode(const Row& row);

/// Refuses whatever encode() would not write: accepted bytes re-encode to themselves.
[[nodiscard]] base::Result<Row> decode(std::span<const std::byte> bytes);

} // namespace hapnet::record
