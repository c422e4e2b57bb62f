// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/profile/text.hpp"
#include "proto/base/result.hpp"

#include <string>

namespace hapnet::emulator {

/// The whole text of a file, at most 64 MiB; the error names the file.
[[nodiscard]] base::Result<std::string> read_text(const std::string& file);

/// Opens files that are named relative to the folder of `file`.
[[nodiscard]] OpenFile files_beside(const std::string& file);

/// The profile of a file, or a preset: what holds a '/' or a '.' is a file. The error names the
/// place in the file, or the presets that there are.
[[nodiscard]] base::Result<Profile> load_profile(const std::string& file_or_name);

/// One line for each preset.
[[nodiscard]] std::string preset_list();

} // namespace hapnet::emulator
