// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hapnet::plot {

// What every page of ours looks like.

/// palette.css and style.css, compiled in.
[[nodiscard]] std::string_view style_sheet();

/// The beginning of a page, up to and with <main>; the title is text, the subject a word. `style`
/// is what its style sheet has besides.
[[nodiscard]] std::string page_head(std::string_view title, std::string_view subject,
                                    std::string_view style = "");
/// Its end.
[[nodiscard]] std::string page_foot(std::string_view scripts = "");

/// A plot of the page as a file of its own, in the light colours of the style sheet.
[[nodiscard]] std::string standalone(std::string_view svg);

} // namespace hapnet::plot
