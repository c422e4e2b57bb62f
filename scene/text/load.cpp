// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/text/text.hpp"

#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::scene {

base::Result<Description> load_scene(const std::string& file_or_name, const base::OpenFile& open)
{
    std::vector<std::string_view> names;
    for (const BuiltInScene& scene : built_in_scenes()) {
        if (scene.name == file_or_name) {
            return parse_scene(scene.text, fmt::format("{}.toml", scene.name));
        }
        names.push_back(scene.name);
    }
    const bool is_file =
        file_or_name.find('/') != std::string::npos || file_or_name.ends_with(".toml");
    const auto text = open(file_or_name);
    if (!text && is_file) return tl::unexpected{text.error()};
    if (!text) {
        return base::fail(fmt::format("there is neither a file nor a scene '{}': {}", file_or_name,
                                      base::suggestion(file_or_name, names)));
    }
    return parse_scene(*text, file_or_name);
}

} // namespace hapnet::scene
