// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::runner {

/// The file beside results that shows whether two folders hold the same: `b2sum -c B2SUMS`.
inline constexpr const char* checksums_name = "B2SUMS";

/// Returns BLAKE2b (RFC 7693) with 32 bytes of each file in a folder, as `b2sum -l 256` prints
/// them. Throws std::system_error when a file cannot be read.
[[nodiscard]] std::string checksums_of(const std::filesystem::path& folder,
                                       std::vector<std::string> names);

/// Returns the checksum of a text: 64 hexadecimal digits.
[[nodiscard]] std::string checksum_of(const std::string& text);

/// Compares the files of a folder with its B2SUMS, and the B2SUMS with the digest in its
/// manifest.json, as far as they exist. The error names the file that is missing or was changed.
[[nodiscard]] base::Result<void> verify_checksums(const std::filesystem::path& folder);

/// Returns a line for a file of JSON lines: the object with one more member at its end, `sum`. It
/// is the BLAKE2b with 16 bytes (`b2sum -l 128`) of the line before the comma in front of that
/// member.
[[nodiscard]] std::string with_sum(std::string object);
/// True for an unchanged line of with_sum(); false for a changed line, or one without a sum.
[[nodiscard]] bool has_right_sum(std::string_view line);

} // namespace hapnet::lab::runner
