// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hapnet::lab {

/// The file beside results that tells whether two folders hold the same: `b2sum -c B2SUMS`.
inline constexpr const char* checksums_name = "B2SUMS";

/// BLAKE2b (RFC 7693) with 32 bytes of each file in a folder, as `b2sum -l 256` prints them. Throws
/// std::system_error when one cannot be read.
[[nodiscard]] std::string checksums_of(const std::filesystem::path& folder,
                                       std::vector<std::string> names);

/// The same of a text: 64 digits.
[[nodiscard]] std::string checksum_of(const std::string& text);

} // namespace hapnet::lab
