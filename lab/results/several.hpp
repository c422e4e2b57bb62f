// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/manifest.hpp"
#include "lab/results/results.hpp"

#include <string>

namespace hapnet::lab::results {

/// True if the manifest is that of a folder whose subfolders hold the results: see
/// several_manifest().
[[nodiscard]] bool is_of_several(const nlohmann::ordered_json& manifest);

/// Returns the manifest.json of such a folder, `root`, with the facts of each subfolder's manifest.
/// The whole is valid when all parts are. It began with the first and took as long as all together.
/// There must be at least one subfolder.
[[nodiscard]] nlohmann::ordered_json
several_manifest(const Results& results, const std::string& root, Circumstances circumstances);

} // namespace hapnet::lab::results
