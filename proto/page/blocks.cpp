// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/page/blocks.hpp"

#include <utility>

namespace hapnet::page {

namespace {

Json array_of(std::vector<Json> values)
{
    Json list = Json::array();
    for (Json& value : values) list.push_back(std::move(value));
    return list;
}

} // namespace

Json bold(std::string_view words) { return Json::object({{"b", words}}); }

Json paragraph(Json text, std::string_view style)
{
    Json block = Json::object();
    block["p"] = std::move(text);
    if (!style.empty()) block["style"] = style;
    return block;
}

Json preformatted(std::string_view words) { return Json::object({{"pre", words}}); }

Json banner(std::string_view style, Json text, std::vector<Json> list)
{
    Json block = Json::object();
    block["banner"] = std::move(text);
    block["style"] = style;
    block["list"] = array_of(std::move(list));
    return block;
}

Json panels(std::string_view size, Json blocks)
{
    return {{"panels", size}, {"blocks", std::move(blocks)}};
}

Json json_of(const Table& table)
{
    Json rows = Json::array();
    for (const auto& row : table.rows) {
        Json cells = Json::array();
        for (const Cell& cell : row) {
            if (cell.style.empty()) {
                cells.push_back(cell.text);
                continue;
            }
            Json styled = Json::object();
            styled["text"] = cell.text;
            styled["style"] = cell.style;
            cells.push_back(std::move(styled));
        }
        rows.push_back(std::move(cells));
    }
    Json inside = Json::object();
    inside["caption"] = table.caption;
    inside["heads"] = array_of(table.heads);
    inside["rows"] = std::move(rows);
    Json block = Json::object();
    block["table"] = std::move(inside);
    return block;
}

} // namespace hapnet::page
