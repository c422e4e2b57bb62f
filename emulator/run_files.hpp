// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fates/fates.hpp"
#include "emulator/core/profile/profile.hpp"
#include "proto/base/result.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>

namespace hapnet::emulator {

// The files of a run, for the commands that read them again. Errors name the file.

/// Statistics as --stats writes them: an object.
[[nodiscard]] base::Result<nlohmann::ordered_json> statistics_in(const std::string& text,
                                                                 const std::string& path);

/// The profile of the run, from its statistics.
[[nodiscard]] base::Result<Profile> profile_of_run(const nlohmann::ordered_json& statistics,
                                                   const std::string& path);

/// The file of fates that the statistics name: as they name it, or beside them. The error says that
/// they name none.
[[nodiscard]] base::Result<std::string> fates_path_of(const nlohmann::ordered_json& statistics,
                                                      const std::string& path);

// The next two functions return the data of one path. `link` names it in a run with several paths;
// nullopt: the run has only one.

/// The fates of the path in a table. The error names the paths that are in it.
[[nodiscard]] base::Result<Fates> fates_of_path(const std::string& fates_path,
                                                const std::optional<std::string>& link);

/// The statistics with those of the path in the place of those of the run; null when they have
/// none of it: of a client that was forgotten.
[[nodiscard]] nlohmann::ordered_json of_path(const nlohmann::ordered_json& statistics,
                                             const std::optional<std::string>& link);

/// Refuses fates that are not those of all datagrams in the statistics. Rows missing at the end of
/// the table leave no gap in it.
[[nodiscard]] base::Result<void> ensure_whole(const Fates& fates,
                                              const nlohmann::ordered_json& statistics);

/// The error says why the fates of this run cannot be tested against its profile: they were
/// replayed, or the conditions changed.
[[nodiscard]] base::Result<void> ensure_testable(const nlohmann::ordered_json& statistics,
                                                 const Profile& profile, const std::string& path);

/// Returns the result of `use`, which reads the statistics in that file. Returns an error that
/// names the file when a value has another type than hapnet-emulator writes.
template <typename Use>
[[nodiscard]] auto with_statistics(const std::string& path, const Use& use) -> decltype(use())
{
    try {
        return use();
    } catch (const nlohmann::json::exception& error) {
        return base::fail(
            fmt::format("{}: a value has another type than --stats of hapnet-emulator "
                        "writes ({}): run it again with --stats FILE",
                        path, error.what()));
    }
}

} // namespace hapnet::emulator
