// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/tidy/source_tree.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hapnet::tidy {

/// The folder of the map that a path belongs to ("emulator/core"; "emulator" for its shell);
/// "" for none, such as tests and third-party headers.
[[nodiscard]] std::string folder_of(std::string_view path);

/// True if a file in folder `from` may include a file in folder `to`. Arrows compose, and a folder
/// may include itself.
[[nodiscard]] bool may_include(std::string_view from, std::string_view to);

/// Includes of the file that follow no arrow, or do not go by path from the root.
[[nodiscard]] std::vector<std::string> wrong_arrows(const SourceFile& file);

/// Headers that a core includes and that would let it do I/O, read a clock or start a thread.
[[nodiscard]] std::vector<std::string> impure_includes(const SourceFile& file);

} // namespace hapnet::tidy
