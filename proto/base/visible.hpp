// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hapnet::base {

/// Makes text from a file or another program safe for a terminal: control characters, those of
/// direction among them, become `\u001B`, and bytes that are not UTF-8 become `\x9B`. Other text is
/// unchanged.
[[nodiscard]] std::string visible(std::string_view text);
/// Does the same as visible() for text of several lines: line ends and tabs are kept.
[[nodiscard]] std::string visible_lines(std::string_view text);

} // namespace hapnet::base
