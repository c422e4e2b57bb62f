// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/doctor/findings.hpp"

#include <filesystem>
#include <string>

namespace hapnet::peer::doctor {

/// Looks at the system whose files begin at `root`, usually "/", and at this process's rights.
/// `hd_library` is as --hd-library; "": by its usual names.
[[nodiscard]] Facts look_at(const std::filesystem::path& root, const std::string& hd_library);

} // namespace hapnet::peer::doctor
