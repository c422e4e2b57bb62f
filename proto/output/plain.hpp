// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hapnet::output {

/// Words about a field without marks of Markdown: `a` and [a](b) become a.
[[nodiscard]] std::string plain(std::string_view words);

} // namespace hapnet::output
