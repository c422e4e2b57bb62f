// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace hapnet::base {

/// A place in a text. Line and column count from 1.
struct Place {
    std::uint32_t line = 1;
    std::uint32_t column = 1;
};

struct Entry;

/// A value of a TOML document, with its place. The entries of a table are in the order of the text.
/// Dates and times are not supported: no text of this project contains any.
struct Node {
    using List = std::vector<Node>;
    using Table = std::vector<Entry>;

    Place place;
    std::variant<bool, std::int64_t, double, std::string, List, Table> value;
};

struct Entry {
    std::string key;
    Place place; // place of the key
    Node value;
};

/// An error for a text that is not TOML, or that exceeds a limit.
struct DocumentError {
    Place place;
    std::string message;
};

inline constexpr std::size_t document_bytes_max = 1 << 20;

/// Parses TOML 1.0 into a tree. The text may have at most `bytes_max` bytes, which is a whole
/// number of MiB. The depth of nesting is limited, so that no text can exhaust the stack.
[[nodiscard]] tl::expected<Node, DocumentError>
parse_document(std::string_view text, std::size_t bytes_max = document_bytes_max);

} // namespace hapnet::base
