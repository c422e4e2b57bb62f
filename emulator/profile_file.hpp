// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/profile/profile.hpp"
#include "proto/base/result.hpp"

#include <string>

namespace hapnet::emulator {

/// The path of a file that the profile in `beside` names: relative to that profile's folder; as it
/// is when `beside` is empty.
[[nodiscard]] std::string path_beside(const std::string& name, const std::string& beside);

/// Reads the preset of that name, or else a file. The error names the file and the line.
[[nodiscard]] base::Result<Profile> load_profile(const std::string& file_or_name);

/// The text of a preset; the error names those that there are.
[[nodiscard]] base::Result<std::string> preset_text(const std::string& name);

} // namespace hapnet::emulator
