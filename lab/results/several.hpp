// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/manifest.hpp"
#include "lab/results/results.hpp"

#include <string>

namespace hapnet::lab::results {

/// True if it is the manifest of a folder whose subfolders hold the results: see below.
[[nodiscard]] bool is_of_several(const nlohmann::ordered_json& manifest);

/// manifest.json of such a folder, `root`: what the manifest of each subfolder says of itself. It
/// is valid when all are, began with the first and took as long as all together. There must be one.
[[nodiscard]] nlohmann::ordered_json
several_manifest(const Results& results, const std::string& root, Circumstances circumstances);

} // namespace hapnet::lab::results
