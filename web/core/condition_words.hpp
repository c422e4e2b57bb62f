// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hapnet::web {

/// Returns settings in the form for a log: "both.delay 160ms, up.loss 1% and 2 more". `settings`
/// has a text for each key. A setting that up and down share appears once, as both.
[[nodiscard]] std::string words_of(const nlohmann::ordered_json& settings);

/// Returns the cause of a change of the conditions, and the settings that differ: "the timeline:
/// both.delay 40ms". Both arguments are replies of an emulator to the request `show`.
[[nodiscard]] std::string words_of_change(const nlohmann::ordered_json& before,
                                          const nlohmann::ordered_json& after);

} // namespace hapnet::web
