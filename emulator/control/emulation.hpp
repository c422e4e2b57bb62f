// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/all_paths.hpp"
#include "emulator/core/profile/profile.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <functional>
#include <optional>
#include <string>

namespace hapnet::emulator {

/// The running emulator as its control sees it. All functions are called between two datagrams,
/// while nothing is relayed.
struct Emulation {
    AllPaths paths;
    /// The statistics as one JSON object.
    std::function<std::string()> statistics_json;
    /// The text of a file that a profile or a setting names; `beside` is the file of the profile,
    /// empty for a setting.
    std::function<base::Result<std::string>(const std::string& name, const std::string& beside)>
        open;
    /// The text of a built-in profile.
    std::function<base::Result<std::string>(const std::string& name)> preset{};
    /// Ends the run, as a signal does.
    std::function<void()> stop{};
    /// What a sentence of tc-netem asks for.
    std::function<base::Result<TranslatedProfile>(const std::string& sentence)> netem{};
    /// How much of the last packets is held in memory; nullopt: none.
    std::optional<base::Duration> held{};
    /// Orders a capture of them since a time; gives its path.
    std::function<base::Result<std::string>(const std::string& name, base::TimePoint from)> keep{};
};

} // namespace hapnet::emulator
