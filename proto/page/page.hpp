// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/page/figure.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::page {

/// A file of web/page, or of a library, that is compiled in.
struct Asset {
    std::string_view name;   // "report/report.js", "three.module.min.js"
    std::string_view bytes;  // content of a file of web/page; empty: a library
    std::string_view packed; // gzip data of a library; empty: a file of web/page
};

/// The files that each page carries: the modules that draw it, and its style sheets. The build
/// generates the file that defines them.
[[nodiscard]] std::span<const Asset> page_assets();

/// A part of a page, with a line in its contents.
struct Section {
    std::string id;
    std::string title;
    Json blocks = Json::array();
    std::vector<Figure> figures{};
    std::vector<std::string> sources{}; // used for figures that are added later without sources

    void add(Json block) { blocks.push_back(std::move(block)); }
    /// Adds a figure, and a block that shows it.
    void add(Figure figure);
    /// Adds a figure, and returns the block that shows it, to stand elsewhere.
    [[nodiscard]] Json keep(Figure figure);
};

struct Page {
    std::string subject; // a word: what the page is about
    std::string title;
    std::string lead;
    Json head = Json::array(); // blocks above the sections
    std::vector<Section> sections{};
    std::string foot{};
};

/// The page as one HTML file that needs no other. It carries its data in one element of JSON, and
/// the modules that draw it, `more` besides.
[[nodiscard]] std::string html_of(const Page& page, std::span<const Asset> more = {});
/// As above, for data that have `subject`, `title`, `figures` and the fields from which `more`
/// makes words and blocks.
[[nodiscard]] std::string html_of(const Json& data, std::span<const Asset> more);

} // namespace hapnet::page
