// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/profile.hpp"
#include "proto/base/result.hpp"

#include <string>
#include <string_view>

namespace hapnet::emulator {

/// The path of a file that the profile in `beside` names: relative to that profile's folder; as it
/// is when `beside` is empty.
[[nodiscard]] std::string path_beside(const std::string& name, const std::string& beside);

/// Returns the text of a file that a client of the control socket names. path_beside() says where
/// it is. Anything but a regular file is refused: a pipe would keep the run waiting.
[[nodiscard]] base::Result<std::string> text_beside(const std::string& name,
                                                    const std::string& beside);

/// Reads the preset of that name, or else a file. The error names the file and the line. The
/// profile may have conditions of the paths in `names`. If there is neither preset nor file, the
/// error names the option, if one was typed.
[[nodiscard]] base::Result<Profile> load_profile(const std::string& file_or_name,
                                                 const PathNames& names = {.any = true},
                                                 std::string_view option = "");

/// The names of the presets, each followed by `separator`.
[[nodiscard]] std::string preset_list(char separator);

/// The text of a preset; the error names those that there are.
[[nodiscard]] base::Result<std::string> preset_text(const std::string& name);

} // namespace hapnet::emulator
