// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace hapnet::device::hdapi {

/// Returns the names that the vendor's set-up has given to devices of this user: its files
/// NAME.config.
[[nodiscard]] std::vector<std::string> configured_names();

} // namespace hapnet::device::hdapi
