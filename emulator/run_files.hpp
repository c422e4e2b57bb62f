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

// Functions for the commands that read the files of a run. Errors name the file.

/// Parses statistics as --stats writes them. The result is an object.
[[nodiscard]] base::Result<nlohmann::ordered_json> statistics_in(const std::string& text,
                                                                 const std::string& path);

/// Returns the profile of the run from its statistics.
[[nodiscard]] base::Result<Profile> profile_of_run(const nlohmann::ordered_json& statistics,
                                                   const std::string& path);

/// Returns the path of the file of fates that the statistics name: the named path, or a file of
/// that name in the folder of the statistics. The error: they name none.
[[nodiscard]] base::Result<std::string> fates_path_of(const nlohmann::ordered_json& statistics,
                                                      const std::string& path);

// The next two functions return the data of one path. `link` names the path in a run with several
// paths. nullopt: the run has only one.

/// Returns the fates of the path from a table. The error lists the paths in the table.
[[nodiscard]] base::Result<Fates> fates_of_path(const std::string& fates_path,
                                                const std::optional<std::string>& link);

/// Returns the statistics in which the values of the path or flow replace those of the run. null:
/// the statistics have no entry for it, for example because the client was forgotten.
[[nodiscard]] nlohmann::ordered_json of_path(const nlohmann::ordered_json& statistics,
                                             const std::optional<std::string>& link);

/// Refuses fates whose number differs from the number of datagrams in the statistics, in either
/// direction. Rows that are missing at the end of a table leave no gap, so nothing else shows that
/// they are missing.
[[nodiscard]] base::Result<void> ensure_whole(const Fates& fates,
                                              const nlohmann::ordered_json& statistics);

/// Returns an error if the fates of this run cannot be tested against its profile, because they
/// were replayed or the conditions changed.
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
