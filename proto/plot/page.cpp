// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/plot/page.hpp"

#include "proto/plot/axis.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::plot {

namespace {

/// What the style sheet first says of "--name": its light colour.
std::string_view light_colour(std::string_view name)
{
    const std::string_view sheet = style_sheet();
    const auto found = sheet.find(fmt::format("{}: ", name));
    if (found == std::string_view::npos) return "#000";
    const auto begin = found + name.size() + 2;
    return sheet.substr(begin, sheet.find(';', begin) - begin);
}

} // namespace

std::string page_head(std::string_view title, std::string_view subject, std::string_view style)
{
    return fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                       "<meta name=\"color-scheme\" content=\"light dark\">\n"
                       "<meta name=\"hapnet-subject\" content=\"{1}\">\n"
                       "<title>{0}</title>\n<style>\n{2}{3}</style>\n</head>\n<body>\n<main>\n",
                       escaped(title), subject, style_sheet(), style);
}

std::string page_foot(std::string_view scripts)
{
    std::string out = "</main>\n";
    if (!scripts.empty()) out += fmt::format("<script>\n{}</script>\n", scripts);
    return out + "</body>\n</html>\n";
}

std::string standalone(std::string_view svg)
{
    constexpr std::string_view opening = "<svg ";
    constexpr std::string_view variable = "var(";
    std::string out{svg.substr(0, opening.size())};
    out += "font-family='sans-serif' font-size='12' color='#1b1f24' style='background:#fff' ";
    svg.remove_prefix(std::min(opening.size(), svg.size()));
    for (auto at = svg.find(variable); at != std::string_view::npos; at = svg.find(variable)) {
        out += svg.substr(0, at);
        svg.remove_prefix(at + variable.size());
        const auto end = std::min(svg.find(')'), svg.size());
        out += light_colour(svg.substr(0, end));
        svg.remove_prefix(std::min(end + 1, svg.size()));
    }
    return out += svg;
}

} // namespace hapnet::plot
