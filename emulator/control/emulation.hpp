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
/// the control. Only steps that read or change the paths are done by `work`, one at a time, between
/// two datagrams.
struct Emulation {
    AllPaths paths; // used by steps of `work` only, except names()
    /// The statistics as one JSON object. It reads the paths in steps of `work`.
    std::function<nlohmann::ordered_json(const control::DoWork& work)> statistics;
    /// Ends the run, as a signal does. In a step of `work`.
    std::function<void()> stop;
    control::DoWork work = control::do_at_once;
    /// The files that a client may name without sending them; none: there is no such folder.
    OpenFile folder{};
    /// The text of a built-in profile.
    std::function<base::Result<std::string>(const std::string& name)> preset{};
    /// Translates a command line of tc-netem into a profile.
    std::function<base::Result<TranslatedProfile>(const std::string& sentence)> netem{};
    /// Length of the last packets that are held in memory; nullopt: no packets are held.
    std::optional<base::Duration> held{};
    /// Orders a capture of the last packets since a time, and returns its path.
    std::function<base::Result<std::string>(const std::string& name, base::TimePoint from)> keep{};
};

} // namespace hapnet::emulator
