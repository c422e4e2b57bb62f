// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::runner {

/// The file beside results that tells whether two folders hold the same: `b2sum -c B2SUMS`.
inline constexpr const char* checksums_name = "B2SUMS";

/// BLAKE2b (RFC 7693) with 32 bytes of each file in a folder, as `b2sum -l 256` prints them. Throws
/// std::system_error when one cannot be read.
[[nodiscard]] std::string checksums_of(const std::filesystem::path& folder,
                                       std::vector<std::string> names);

/// Returns the checksum of a text: 64 digits.
[[nodiscard]] std::string checksum_of(const std::string& text);

/// Compares the files of a folder with its B2SUMS, and that with the digest in its manifest.json,
/// as far as they are there. The error names the file that is missing or was changed.
[[nodiscard]] base::Result<void> verify_checksums(const std::filesystem::path& folder);

/// A line for a file of JSON lines: an object with one more member at its end, `sum`, the BLAKE2b
/// with 16 bytes (`b2sum -l 128`) of all of the line before the comma in front of that member.
[[nodiscard]] std::string with_sum(std::string object);
/// True for a line as with_sum() makes it; false for one that was changed, or that has no sum.
[[nodiscard]] bool has_right_sum(std::string_view line);

} // namespace hapnet::lab::runner
