// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/profile/reading.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// The keys of a direction, in the order of the stages. "burst_loss" is a further law of loss.
inline constexpr std::array<std::string_view, 10> setting_keys{
    "mtu",       "rate",  "loss",   "burst_loss", "corrupt",
    "duplicate", "delay", "jitter", "order",      "reorder"};

/// What the keys of one direction say. The outer optional: the key is there; an empty list: there
/// is no such burst.
struct DirectionSettings {
    Patch patch;
    std::optional<std::vector<LossLaw>> burst_loss{};
};

/// What the entry of this key says, into `settings`. `key` is one of setting_keys.
void read_setting(std::string_view key, const Node& node, DirectionSettings& settings,
                  Reading& reading);

/// What a table of such keys says. Complains of unknown keys, and of orders that contradict.
[[nodiscard]] DirectionSettings read_direction(const Node& node, Reading& reading);

/// `a` and what `b` says besides or instead.
[[nodiscard]] Patch merged(Patch a, const Patch& b);

/// The values of the keys as TOML; nullopt: not set. burst_loss is never set: it is part of loss.
[[nodiscard]] std::array<std::optional<std::string>, setting_keys.size()>
setting_texts(const Patch& patch);

/// What `conditions` say that differs from the default.
[[nodiscard]] Patch patch_of(const Conditions& conditions);

} // namespace hapnet::emulator
