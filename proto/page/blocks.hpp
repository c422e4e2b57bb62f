// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::page {

// The content of a page, as data that web/page/report turns into elements. A text is a string, or a
// list of strings and of pieces such as bold(). Line breaks in it are kept. Nothing is interpreted
// as markup.

using Json = nlohmann::ordered_json;

[[nodiscard]] Json bold(std::string_view words);

[[nodiscard]] Json paragraph(Json text, std::string_view style = "");
/// A text whose line breaks and spaces are kept.
[[nodiscard]] Json preformatted(std::string_view words);
/// A framed text about a result. Its styles are "met", "missed" and "".
[[nodiscard]] Json banner(std::string_view style, Json text, std::vector<Json> list = {});
/// Blocks side by side; `size` is "", "small" or "tiny".
[[nodiscard]] Json panels(std::string_view size, Json blocks);
/// A cell of a table. `style` is a class of report.css.
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
