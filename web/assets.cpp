// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/assets.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::web {

namespace {

/// FNV-1a. It only distinguishes one build from another.
std::uint64_t hash_of_all()
{
    std::uint64_t hash = 0xcbf2'9ce4'8422'2325U;
    for (const Asset& asset : assets()) {
        for (const std::string_view text : {asset.name, asset.bytes}) {
            for (const char c : text) {
                hash = (hash ^ static_cast<unsigned char>(c)) * 0x0000'0100'0000'01b3U;
            }
        }
    }
    return hash;
}

const Asset* asset_named(std::string_view name)
{
    const auto all = assets();
    const auto found = std::ranges::find(all, name, &Asset::name);
    return found == all.end() ? nullptr : &*found;
}

} // namespace

std::string_view media_type(std::string_view name)
{
    constexpr std::array types{
        std::pair{".html", "text/html; charset=utf-8"},
        std::pair{".css", "text/css; charset=utf-8"},
        std::pair{".js", "text/javascript; charset=utf-8"},
        std::pair{".svg", "image/svg+xml"},
        std::pair{".png", "image/png"},
        std::pair{".json", "application/json"},
        std::pair{".txt", "text/plain; charset=utf-8"},
    };
    for (const auto& [ending, type] : types) {
        if (name.ends_with(ending)) return type;
    }
    return "application/octet-stream";
}

Page::Page() : hash_{fmt::format("{:016x}", hash_of_all())}
{
    constexpr std::string_view mark = "@@";
    const Asset* index = asset_named("index.html");
    std::string_view rest =
        index != nullptr ? index->bytes : "<!doctype html><title>hapnet</title>";
    while (true) {
        const auto begin = rest.find(mark);
        const auto end =
            begin == std::string_view::npos ? begin : rest.find(mark, begin + mark.size());
        if (end == std::string_view::npos) break;
        index_ += rest.substr(0, begin);
        const auto name = rest.substr(begin + mark.size(), end - begin - mark.size());
        // The page must not request a file that the build lacks, as three.js may be.
        if (asset_named(name) != nullptr) index_ += fmt::format("/a/{}/{}", hash_, name);
        rest.remove_prefix(end + mark.size());
    }
    index_ += rest;
}

const Asset* Page::find(std::string_view path) const
{
    constexpr std::string_view folder = "/a/";
    if (!path.starts_with(folder)) return nullptr;
    path.remove_prefix(folder.size());
    if (!path.starts_with(hash_) || path.size() <= hash_.size() || path[hash_.size()] != '/') {
        return nullptr;
    }
    return asset_named(path.substr(hash_.size() + 1));
}

} // namespace hapnet::web
