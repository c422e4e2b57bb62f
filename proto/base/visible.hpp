// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hapnet::base {

/// Text from a file or another program, as a terminal may show it: control characters become
/// `\u001B`, and bytes that are not UTF-8 become `\x9B`. Other text stays as it is.
[[nodiscard]] std::string visible(std::string_view text);
/// Like visible(), for text of several lines: line ends and tabs stay.
[[nodiscard]] std::string visible_lines(std::string_view text);

} // namespace hapnet::base
