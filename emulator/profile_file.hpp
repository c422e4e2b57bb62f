// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/profile.hpp"
#include "proto/base/result.hpp"

#include <string>
#include <string_view>

namespace hapnet::emulator {

/// Returns the path of a file that the profile in `beside` names. The name is relative to that
/// profile's folder. If `beside` is empty, the name is returned unchanged.
[[nodiscard]] std::string path_beside(const std::string& name, const std::string& beside);

/// Returns the text of a file that a client of the control socket names. path_beside() determines
/// its path. Anything but a regular file is refused: a pipe would keep the run waiting.
[[nodiscard]] base::Result<std::string> text_beside(const std::string& name,
                                                    const std::string& beside);

/// Reads the preset of that name, or else a file. The error names the file and the line. The
/// profile may set conditions for the paths in `names`. If there is neither preset nor file, the
/// error names the option, if one was typed.
[[nodiscard]] base::Result<Profile> load_profile(const std::string& file_or_name,
                                                 const PathNames& names = {.any = true},
                                                 std::string_view option = "");

/// Returns the names of the presets, each followed by `separator`.
[[nodiscard]] std::string preset_list(char separator);

/// Returns the text of a preset. The error lists the existing presets.
[[nodiscard]] base::Result<std::string> preset_text(const std::string& name);

} // namespace hapnet::emulator
