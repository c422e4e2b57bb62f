// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <string>

namespace hapnet::net {

/// The whole text of a file of at most 64 MiB; the error names it and says why it cannot be read.
[[nodiscard]] base::Result<std::string> text_of_file(const std::string& path);

} // namespace hapnet::net
