// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/page/page.hpp"

#include "proto/page/base64.hpp"

#include <array>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::page {

namespace {

constexpr std::string_view loader_name = "report/loader.js";

std::string escaped(std::string_view text)
{
    std::string out;
    for (const char c : text) {
        switch (c) {
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        case '&': out += "&amp;"; break;
        case '"': out += "&quot;"; break;
        default: out += c;
        }
    }
    return out;
}

/// Returns an element with JSON. The JSON contains nothing that closes the element.
std::string json_element(std::string_view id, const Json& json)
{
    std::string text;
    for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace)) {
        if (c == '<') {
            text += "\\u003c";
        } else {
            text += c;
        }
    }
    return fmt::format("<script type=\"application/json\" id=\"{}\">{}</script>\n", id, text);
}

Json data_of(const Page& page)
{
    Json sections = Json::array(), figures = Json::array();
    for (const Section& section : page.sections) {
        sections.push_back(
            {{"id", section.id}, {"title", section.title}, {"blocks", section.blocks}});
        for (const Figure& figure : section.figures) figures.push_back(json_of(figure));
    }
    Json data{{"subject", page.subject}, {"title", page.title}, {"lead", page.lead}};
    data["head"] = page.head;
    data["sections"] = std::move(sections);
    data["foot"] = page.foot;
    data["figures"] = std::move(figures);
    return data;
}

/// The modules, and separately the style sheets.
struct Carried {
    Json plain = Json::object();
    Json packed = Json::object();
    std::string style;
    std::string loader;
};

Carried carried(std::span<const Asset> more)
{
    Carried out;
    for (const auto assets : {page_assets(), more}) {
        for (const Asset& asset : assets) {
            const std::string name{asset.name};
            if (name == loader_name) {
                out.loader = asset.bytes;
            } else if (name.ends_with(".css")) {
                out.style += asset.bytes;
            } else if (!asset.bytes.empty()) {
                out.plain[name] = asset.bytes;
            } else {
                out.packed[name] = base64(asset.packed);
            }
        }
    }
    return out;
}

} // namespace

void Section::add(Figure figure) { blocks.push_back(keep(std::move(figure))); }

Json Section::keep(Figure figure)
{
    if (figure.sources.empty()) figure.sources = sources;
    Json block = Json::object({{"figure", figure.id}});
    figures.push_back(std::move(figure));
    return block;
}

std::string html_of(const Page& page, std::span<const Asset> more)
{
    return html_of(data_of(page), more);
}

std::string html_of(const Json& data, std::span<const Asset> more)
{
    Carried files = carried(more);
    Json modules{{"plain", std::move(files.plain)}, {"packed", std::move(files.packed)}};
    return fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                       "<meta name=\"color-scheme\" content=\"light dark\">\n"
                       "<meta name=\"hapnet-subject\" content=\"{}\">\n"
                       "<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n<main></main>\n"
                       "<noscript><p>This page is drawn by JavaScript. Its numbers stand in the "
                       "element hapnet-data.</p></noscript>\n",
                       data.at("subject").get<std::string>(),
                       escaped(data.at("title").get<std::string>()), files.style) +
           json_element("hapnet-data", data) + json_element("modules", modules) +
           fmt::format("<script>\n{}</script>\n</body>\n</html>\n", files.loader);
}

} // namespace hapnet::page
