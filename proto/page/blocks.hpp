// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::page {

// The content of a page, as data that web/page/report turns into elements. A text is a string, or a
// list of strings and of such pieces as bold(); a line break in it stays one. Nothing is markup.

using Json = nlohmann::ordered_json;

[[nodiscard]] Json bold(std::string_view words);

[[nodiscard]] Json paragraph(Json text, std::string_view style = "");
/// Words whose lines and spaces stay as they are.
[[nodiscard]] Json preformatted(std::string_view words);
/// A text in a frame that says how something went: "met", "missed" or "" are its styles.
[[nodiscard]] Json banner(std::string_view style, Json text, std::vector<Json> list = {});
/// Blocks beside each other; `size` is "", "small" or "tiny".
[[nodiscard]] Json panels(std::string_view size, Json blocks);
/// A cell of a table, in the look of a class of report.css.
struct Cell {
    Json text;
    std::string style{};
};

struct Table {
    std::string caption;
    std::vector<Json> heads;
    std::vector<std::vector<Cell>> rows{}; // the first cell names the row
};

[[nodiscard]] Json json_of(const Table& table);

} // namespace hapnet::page
