// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/all_paths.hpp"
#include "emulator/core/profile/profile.hpp"
#include "emulator/core/profile/reading.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "proto/control/core/work.hpp"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace hapnet::emulator {

/// The running emulator as its control sees it. Everything that takes time happens on the thread of
/// the control. `work` only does the steps that read or change the paths, one at a time, between
/// two datagrams.
struct Emulation {
    AllPaths paths; // used by steps of `work` only, except names()
    /// Returns the statistics as one JSON object. It reads the paths in steps of `work`.
    std::function<nlohmann::ordered_json(const control::DoWork& work)> statistics;
    /// Ends the run, as a signal does. Call it in a step of `work`.
    std::function<void()> stop;
    control::DoWork work = control::do_at_once;
    /// Opens the files that a client may name without sending them. null: there is no such folder.
    OpenFile folder{};
    /// Returns the text of a built-in profile.
    std::function<base::Result<std::string>(const std::string& name)> preset{};
    /// Translates a command line of tc-netem into a profile.
    std::function<base::Result<TranslatedProfile>(const std::string& sentence)> netem{};
    /// Time span of the latest packets, which are held in memory; nullopt: no packets are held.
    std::optional<base::Duration> held{};
    /// Orders a capture of the held packets since `from`, and returns the path of its file.
    std::function<base::Result<std::string>(const std::string& name, base::TimePoint from)> keep{};
};

} // namespace hapnet::emulator
