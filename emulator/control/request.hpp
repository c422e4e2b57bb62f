// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "proto/control/core/request.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace hapnet::emulator {

// Requests of the control socket's clients; docs/formats/control.md describes them.

/// A key and its value as a profile or a command line writes them: "both.delay", "80ms".
using SettingText = std::pair<std::string, std::string>;

/// The texts of the files that a request names, if the request contains them. nullopt: it contains
/// none, and the names are those of files in the emulator's folder.
using SentFiles = std::optional<std::map<std::string, std::string>>;
/// The most bytes that all file texts of one request have together.
inline constexpr std::size_t sent_bytes_max = std::size_t{1} << 20;

/// A profile in a request: its text, the name of a built-in profile, or a sentence of tc-netem.
struct ProfileText {
    std::string toml;
    std::string file;                    // name of the file in messages
    std::optional<std::string> preset{}; // instead of `toml` and `file`
    std::optional<std::string> netem{};  // instead of `toml`, `file` and `preset`
};

struct ShowRequest {};
struct SetRequest {
    std::vector<SettingText> settings; // at least one setting
    std::optional<base::Duration> lasting;
    SentFiles files{};
};
struct ApplyRequest {
    ProfileText profile;
    SentFiles files{};
};
struct DiffRequest {
    ProfileText profile;
    SentFiles files{};
};
struct ResetRequest {};
struct StatsRequest {};
struct MetricsRequest {};
struct StopRequest {};
using control::KeepRequest;
using control::WaitRequest;
using control::WatchRequest;

using Request =
    std::variant<ShowRequest, SetRequest, ApplyRequest, DiffRequest, ResetRequest, StatsRequest,
                 MetricsRequest, WaitRequest, WatchRequest, KeepRequest, StopRequest>;

/// The greatest number of settings in one request, and of files.
inline constexpr std::size_t settings_max = 64;
inline constexpr std::size_t files_max = 64;
/// Room for a profile of 1 MiB and for files of 1 MiB, both encoded as JSON.
inline constexpr std::size_t request_bytes_max = std::size_t{3} << 20;

/// Reads one line. The error says what is wrong and what would be right. `held`: the time span of
/// the latest packets that is in memory; nullopt: no packets are held.
[[nodiscard]] base::Result<Request> parse_request(std::string_view line,
                                                  std::optional<base::Duration> held = {});

} // namespace hapnet::emulator
