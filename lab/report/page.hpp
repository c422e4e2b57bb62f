// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hapnet::lab::report {

// What every page of ours looks like. The style sheet and the scripts are files of page/, compiled
// in.

[[nodiscard]] std::string_view style_sheet();
/// Zooming of plots, and the player of replays.
[[nodiscard]] std::string_view zoom_script();
[[nodiscard]] std::string_view player_script();

/// The beginning of a page, up to and with <main>; the title is text, the subject a word.
[[nodiscard]] std::string page_head(std::string_view title, std::string_view subject);
/// Its end.
[[nodiscard]] std::string page_foot(std::string_view scripts = "");

/// A plot of the page as a file of its own, in the light colours of the style sheet.
[[nodiscard]] std::string standalone(std::string_view svg);

} // namespace hapnet::lab::report
