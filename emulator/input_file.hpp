// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <cstddef>
#include <string>

namespace hapnet::emulator {

/// The largest file that is read: a profile, a table, a trace.
inline constexpr std::size_t input_bytes_max = std::size_t{64} << 20;

/// The text of a regular file. Never waits for anybody, as a pipe would. The error names the file.
[[nodiscard]] base::Result<std::string> read_input_file(const std::string& path);

/// The same for a file that another one names: a relative name is found beside that one, or from
/// the working folder when `beside` is empty.
[[nodiscard]] base::Result<std::string> read_input_file(const std::string& name,
                                                        const std::string& beside);

} // namespace hapnet::emulator
