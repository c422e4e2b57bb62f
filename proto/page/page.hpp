// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/page/figure.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::page {

/// A file of web/page or of a library, which is compiled into the program.
struct Asset {
    std::string_view name;   // "report/report.js", "three.module.min.js"
    std::string_view bytes;  // content of a file of web/page; empty: a library
    std::string_view packed; // gzip data of a library; empty: a file of web/page
};

/// Returns the files that each page contains: the modules that draw it, and its style sheets. The
/// build generates the source file that defines this function.
[[nodiscard]] std::span<const Asset> page_assets();

/// A section of a page, which has an entry in the table of contents.
struct Section {
    std::string id;
    std::string title;
    Json blocks = Json::array();
    std::vector<Figure> figures{};
    std::vector<std::string> sources{}; // sources of figures that are added later without their own

    void add(Json block) { blocks.push_back(std::move(block)); }
    /// Adds a figure, and a block that shows it.
    void add(Figure figure);
    /// Adds a figure, and returns the block that shows it, for use in another place.
    [[nodiscard]] Json keep(Figure figure);
};

struct Page {
    std::string subject; // one word for the topic of the page
    std::string title;
    std::string lead;
    Json head = Json::array(); // blocks above the sections
    std::vector<Section> sections{};
    std::string foot{};
};

/// Returns the page as one self-contained HTML file. It contains its data in one element of JSON,
/// and the modules that draw it, including `more`.
[[nodiscard]] std::string html_of(const Page& page, std::span<const Asset> more = {});
/// Returns such a file for data that have `subject`, `title`, `figures` and the fields from which
/// `more` makes text and blocks.
[[nodiscard]] std::string html_of(const Json& data, std::span<const Asset> more);

} // namespace hapnet::page
