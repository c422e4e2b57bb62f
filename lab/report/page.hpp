// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace hapnet::lab::report {

/// A file of web/page or of its libraries that is compiled in.
struct Asset {
    std::string_view name;   // "report/report.js", "three.core.min.js"
    std::string_view bytes;  // empty: of a library
    std::string_view packed; // by gzip; empty: of the page itself
};

/// All that a report can carry; a generated file has them. Without libraries at build time those
/// are not among them, and pages draw flat.
[[nodiscard]] std::span<const Asset> page_assets();

/// What a page shows: it carries no more than that takes.
struct PageParts {
    bool has_figures = false;
    bool has_player = false;
};

/// The style sheet of what web/page draws.
[[nodiscard]] std::string page_style();
/// The element with the modules that draw such a page; empty when it has neither.
[[nodiscard]] std::string page_modules(const PageParts& parts);
/// The script that starts them.
[[nodiscard]] std::string_view loader_script();

} // namespace hapnet::lab::report
