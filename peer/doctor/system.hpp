// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/doctor/findings.hpp"

#include <filesystem>
#include <string>

namespace hapnet::peer::doctor {

/// Collects facts about the system whose root folder is `root`, usually "/", and about this
/// process's rights. `hd_library` is the value of --hd-library; "": the usual names are tried.
[[nodiscard]] Facts look_at(const std::filesystem::path& root, const std::string& hd_library);

} // namespace hapnet::peer::doctor
