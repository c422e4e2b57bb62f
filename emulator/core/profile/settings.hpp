// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/reading.hpp"
#include "emulator/core/profile/regimes.hpp"
#include "proto/base/result.hpp"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// The keys of a direction, in the order of the stages. "burst_loss" is an additional law of loss.
/// "correlation_time" belongs to the jitter, or to a delay with a law. "regimes" sets whether the
/// regimes of both directions change together.
inline constexpr std::array<std::string_view, 14> setting_keys{
    "mtu",     "rate",      "queue",  "loss",   "burst_loss",
    "corrupt", "duplicate", "delay",  "jitter", "correlation_time",
    "order",   "reorder",   "regime", "regimes"};

/// The settings from the keys of one direction. For nested optionals: the outer one is set if the
/// key exists. An empty list: there is no such burst.
struct DirectionSettings {
    Patch patch;
    std::optional<std::vector<LossLaw>> burst_loss{};
    std::optional<base::Duration> correlation_time{};
    std::vector<RegimePatch> of_regimes{}; // changes of regimes that exist already
    std::optional<bool> are_together{};    // both directions always have the same regime
};

/// Returns the variation that a correlation time applies to: the jitter, or the delay if there is
/// no jitter. nullptr: neither varies.
[[nodiscard]] Variation* correlated(Conditions& conditions);
inline constexpr std::string_view nothing_to_correlate =
    "correlation_time goes with a jitter, or with a delay that varies: write one beside it";

/// Reads the entry of a key into `settings`. `key` is one of setting_keys.
void read_setting(std::string_view key, const Node& node, DirectionSettings& settings,
                  Reading& reading);

/// Reads a table of such keys. Reports unknown keys, and orders that contradict each other.
[[nodiscard]] DirectionSettings read_direction(const Node& node, Reading& reading);

/// The values of the keys as TOML; nullopt: not set. burst_loss and correlation_time are never set,
/// because they are part of loss and of jitter or delay.
using SettingTexts = std::array<std::optional<std::string>, setting_keys.size()>;
[[nodiscard]] SettingTexts setting_texts(const Patch& patch);

/// One setting, as an option or a live command sets it: `up.delay` and `300ms`.
struct Setting {
    std::optional<Direction> direction; // nullopt: both ways
    DirectionSettings settings;
    std::string path{}; // empty: the setting is for all paths
};

/// Reads a setting. `key` is NAME, both.NAME, up.NAME or down.NAME with a NAME of setting_keys
/// ("burst-loss" is equivalent to "burst_loss"). It may begin with the name of a path that `names`
/// has: 1-2.NAME, wan.up.NAME. With regime.R. before NAME it is a setting of the regime R:
/// up.regime.bad.delay. `value` is written as in a profile, without the quotes: 5ms, 40/100, { law
/// = "normal", sd = "3ms" }, ["5%", "40/100"]. Errors begin with `key`.
[[nodiscard]] base::Result<Setting> parse_setting(std::string_view key, std::string_view value,
                                                  const OpenFile& open,
                                                  const PathNames& names = {});

/// Returns `path`, which is called `name`, with the settings for all paths and those for this path.
/// Settings for all paths apply first, then those for this path. In each group those for both
/// directions apply first, then those for one direction, each in their order. burst_loss and
/// correlation_time apply last. burst_loss replaces the bursts without a phase in the list of
/// losses, or is added to the list. The error: more laws than a direction may have, nothing to
/// correlate, a regime that does not exist, or regimes that cannot be together.
[[nodiscard]] base::Result<Path> with_settings(Path path, std::span<const Setting> settings,
                                               std::string_view name = {});

/// Refuses settings, for all paths or for this one, that the regimes of `path` set themselves; see
/// ensure_own().
[[nodiscard]] base::Result<void> ensure_own_settings(std::span<const Setting> settings,
                                                     std::string_view name, const Path& path);

/// Returns the patch of one direction from the settings for all paths and for this one. `after` are
/// the conditions of the path's direction with these settings.
[[nodiscard]] Patch patch_of(std::span<const Setting> settings, std::string_view name,
                             Direction direction, const Conditions& after);

} // namespace hapnet::emulator
