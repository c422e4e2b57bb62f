// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/real_time.hpp"
#include "proto/base/result.hpp"
#include "proto/record/reader.hpp"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::lab {

/// Reads the records of the peers 1, 2, ... in the folder of a session.
[[nodiscard]] base::Result<std::vector<record::Record>> records_in(const std::string& folder,
                                                                   std::size_t peers);

/// Returns the times of each peer's ticks. The peers ran on one machine, which has one clock.
[[nodiscard]] std::vector<std::vector<base::Duration>>
ticks_in(const std::vector<record::Record>& records);

/// Adds the facts about sessions in real time to the manifest.json of a folder. Writes a new
/// manifest if there is none, or if the present one is about such sessions alone.
[[nodiscard]] base::Result<void> note_in_manifest(const std::string& folder,
                                                  nlohmann::ordered_json real_time);

} // namespace hapnet::lab
