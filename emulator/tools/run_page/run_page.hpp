// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fates/fates.hpp"
#include "emulator/core/profile/profile.hpp"
#include "emulator/tools/verify/verify.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace hapnet::emulator::tools {

/// The files that a run has written.
struct RunRecord {
    nlohmann::ordered_json statistics; // as --stats writes them; an object
    Profile profile;                   // profile at the start of the run
    std::optional<Fates> fates;        // nullopt: the run wrote none
    std::optional<Verification> verification;
    std::string why_unverified; // why there is no verification
    std::string link{};         // name of the link, for a run with several paths
    // The names of the two files, which figures name as their sources.
    std::string statistics_file{};
    std::string fates_file{};
};

/// Returns a self-contained page about one run: its conditions and its results.
[[nodiscard]] std::string run_page(const RunRecord& run);

} // namespace hapnet::emulator::tools
