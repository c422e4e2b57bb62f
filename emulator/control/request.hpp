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

/// The texts of the files that a request names, as it brings them along; nullopt: it brings none,
/// and names those of the emulator's folder.
using SentFiles = std::optional<std::map<std::string, std::string>>;
/// The most bytes of all texts of one request together.
inline constexpr std::size_t sent_bytes_max = std::size_t{1} << 20;

/// A profile as it was sent, the name of a built-in one, or a sentence of tc-netem.
struct ProfileText {
    std::string toml;
    std::string file;                    // name of the file in messages
    std::optional<std::string> preset{}; // instead of `toml` and `file`
    std::optional<std::string> netem{};  // instead of the other three
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

/// The most settings, and the most files, of one request.
inline constexpr std::size_t settings_max = 64;
inline constexpr std::size_t files_max = 64;
/// A profile of 1 MiB and as much in files, both as JSON writes them.
inline constexpr std::size_t request_bytes_max = std::size_t{3} << 20;

/// Reads one line. The error says what is wrong and what would be right. `held`: how much of the
/// last packets is in memory; nullopt: none.
[[nodiscard]] base::Result<Request> parse_request(std::string_view line,
                                                  std::optional<base::Duration> held = {});

} // namespace hapnet::emulator
