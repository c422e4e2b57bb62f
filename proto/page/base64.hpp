// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hapnet::page {

/// Returns bytes in the Base 64 encoding of RFC 4648, section 4.
[[nodiscard]] std::string base64(std::string_view bytes);

} // namespace hapnet::page
