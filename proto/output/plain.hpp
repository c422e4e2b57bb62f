// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hapnet::output {

/// Returns a description without Markdown syntax: `a` and [a](b) become a.
[[nodiscard]] std::string plain(std::string_view words);

} // namespace hapnet::output
