// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/record/rows.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace hapnet::record {

/// The length of a row of a tick or a session.
inline constexpr std::size_t row_bytes = 216;
/// The length of a row of a body, since version 5.
inline constexpr std::size_t body_row_bytes = 117;
/// The number of bytes in a message row before the message.
inline constexpr std::size_t message_head_bytes = 21;

/// The layout of the rows of a file. All rows of one kind have the same length.
struct Layout {
    /// Version 2 has no `from` in message rows and fewer fields in session rows. Version 4 is
    /// version 3 with rows of bodies. Version 5 adds their owner to these rows.
    static constexpr int version_min = 2;
    static constexpr int version_max = 5;

    int version = 3;
    std::size_t message_row_bytes = message_head_bytes + MessageRow::bytes_max;

    /// Returns the layout for messages of at most this many bytes.
    [[nodiscard]] static constexpr Layout for_messages_of(std::size_t bytes)
    {
        return {.message_row_bytes = message_head_bytes + bytes};
    }
    /// Returns the layout that also has rows of bodies, with messages of the same length.
    [[nodiscard]] constexpr Layout with_bodies() const
    {
        return {.version = 5, .message_row_bytes = message_row_bytes};
    }
    [[nodiscard]] constexpr bool has_bodies() const { return version >= 4; }
    [[nodiscard]] constexpr std::size_t bytes_of_body() const
    {
        return version >= 5 ? body_row_bytes : body_row_bytes - sizeof(BodyRow::owner);
    }
    /// True if the rows of this layout have the field of this name, which must be a field of some
    /// row in the newest version.
    [[nodiscard]] bool has_field(std::string_view name) const;
    [[nodiscard]] static constexpr Layout of_version_2()
    {
        return {.version = 2, .message_row_bytes = row_bytes};
    }
    [[nodiscard]] static constexpr Layout of_version_4() { return {.version = 4}; }
    /// Returns the length of the longest message that fits.
    [[nodiscard]] constexpr std::size_t message_bytes_max() const
    {
        return message_row_bytes - message_head_bytes + (version == 2 ? 2 : 0);
    }
    /// Returns the length of a row that begins with this byte; nullopt if there is no such kind.
    [[nodiscard]] std::optional<std::size_t> bytes_of(std::byte kind) const;
};

using RowBytes = std::vector<std::byte>;

/// Encodes a row as one byte for its kind, its fields (fields.hpp) in little-endian order without
/// alignment, and zeros up to the row's length. The layout must have such rows, and a message must
/// fit. Times beyond 36 years are written, but decode() refuses them.
[[nodiscard]] RowBytes encode(const Row& row, const Layout& layout = {});

/// Decodes a row. Refuses bytes that encode() would not write, so accepted bytes encode to
/// themselves.
[[nodiscard]] base::Result<Row> decode(std::span<const std::byte> bytes, const Layout& layout = {});

} // namespace hapnet::record
