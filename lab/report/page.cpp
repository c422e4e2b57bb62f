// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/page.hpp"

#include "lab/report/base64.hpp"
#include "lab/report/drawing.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

constexpr std::string_view loader_name = "report/loader.js";
constexpr std::string_view style_name = "shared.css";

std::string_view text_of_asset(std::string_view name)
{
    const auto all = page_assets();
    const auto found = std::ranges::find(all, name, &Asset::name);
    return found == all.end() ? std::string_view{} : found->bytes;
}

} // namespace

std::string page_style() { return std::string{text_of_asset(style_name)}; }

std::string_view loader_script() { return text_of_asset(loader_name); }

std::string page_modules(const PageParts& parts)
{
    if (!parts.has_figures && !parts.has_player) return "";
    auto own = nlohmann::ordered_json::object(), libraries = own;
    for (const Asset& asset : page_assets()) {
        const bool is_elsewhere = asset.name == loader_name || asset.name == style_name;
        const bool is_of_worlds = asset.name.starts_with("three");
        if (is_elsewhere || (is_of_worlds && !parts.has_player)) continue;
        if (!asset.bytes.empty()) own[std::string{asset.name}] = asset.bytes;
        if (!asset.packed.empty()) libraries[std::string{asset.name}] = base64(asset.packed);
    }
    return fmt::format("<script type='application/json' id='modules'>{}</script>\n",
                       in_script({{"plain", std::move(own)}, {"packed", std::move(libraries)}}));
}

} // namespace hapnet::lab::report
