// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hapnet::test {

/// Returns the JSON that an element of a page contains.
inline nlohmann::ordered_json json_in(std::string_view page, std::string_view id)
{
    const std::string opening = "<script type=\"application/json\" id=\"" + std::string{id} + "\">";
    const auto begin = page.find(opening);
    EXPECT_NE(begin, std::string_view::npos) << id;
    if (begin == std::string_view::npos) return {};
    const auto end = page.find("</script>", begin);
    return nlohmann::ordered_json::parse(
        page.substr(begin + opening.size(), end - begin - opening.size()));
}

/// The data that a page is drawn from.
inline nlohmann::ordered_json data_of(std::string_view page)
{
    return json_in(page, "hapnet-data");
}

/// The figure with this id; null when the page has none.
inline nlohmann::ordered_json figure_of(std::string_view page, std::string_view id)
{
    const auto data = data_of(page); // outlives the loop
    for (const auto& figure : data.at("figures")) {
        if (figure.at("id").get<std::string>() == id) return figure;
    }
    return nullptr;
}

/// The data without figures as text, to look for words in.
inline std::string words_of(std::string_view page)
{
    auto data = data_of(page);
    data.erase("figures");
    data.erase("replays");
    return data.dump();
}

} // namespace hapnet::test
