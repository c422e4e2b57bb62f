// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/fates/fates.hpp"
#include "emulator/core/profile/profile.hpp"
#include "emulator/core/profile/reading.hpp"
#include "proto/base/result.hpp"

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// Conditions of a regime that exists already.
struct RegimePatch {
    std::string regime;
    Patch own;
};

/// Reads a list of tables, each with a name, a stay and conditions: all regimes of a direction.
/// "none" or an empty list: there are none.
[[nodiscard]] base::SharedVector<Regime> read_regimes(const Node& node, Reading& reading);
/// Reads a table of tables by their names: conditions of regimes that exist already.
[[nodiscard]] std::vector<RegimePatch> read_regime_patches(const Node& node, Reading& reading);
/// Prints the regimes as TOML, on one line.
[[nodiscard]] std::string regimes_text(const Regimes& regimes);

/// Returns the regimes with the changed conditions. The error: there is no regime of this name.
[[nodiscard]] base::Result<Regimes> with_patch(const Regimes& regimes, const RegimePatch& patch);

/// Refuses a setting of a direction that its regimes set themselves, because it would have no
/// effect in these regimes. The error says what to write instead. `way` is the prefix of the keys:
/// "up.".
[[nodiscard]] base::Result<void> ensure_own(const Patch& patch, const Regimes& regimes,
                                            std::string_view way);

/// Names of the regimes of a path, up and down.
using NamesOfRegimes = std::array<RegimeNames, 2>;
[[nodiscard]] NamesOfRegimes names_of_regimes(const Path& path);

/// True if any path has regimes.
[[nodiscard]] bool has_regimes(const Profile& profile);

/// Returns a function that gives the regimes that a path has at the beginning, by its name; empty:
/// no path has regimes.
[[nodiscard]] std::function<NamesOfRegimes(const std::string& path)>
regimes_of_paths(const Profile& profile);

/// Refuses regimes that differ from the current ones of a path: fates refer to regimes by number,
/// and statistics by name.
[[nodiscard]] base::Result<void> ensure_same_regimes(const Path& path, const Path& now);

} // namespace hapnet::emulator
