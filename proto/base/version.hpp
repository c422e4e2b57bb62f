// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hapnet::base {

/// Returns the version in project() of CMakeLists.txt: "1.2.3".
[[nodiscard]] std::string_view version();
/// Returns the commit that the program was built from, with "-dirty" if the tree was changed, or
/// "unknown" outside a git checkout.
[[nodiscard]] std::string_view commit();
/// Returns the compiler: "GCC 12.2.0".
[[nodiscard]] std::string_view compiler();
/// Returns the output of `--version`: "hapnet-peer 1.2.3 (commit abc, GCC 12.2.0)".
[[nodiscard]] std::string version_line(std::string_view program);

} // namespace hapnet::base
