// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/profile_file.hpp"

#include "emulator/core/profile/text.hpp"
#include "emulator/presets.hpp"
#include "proto/net/text_file.hpp"

#include <cctype>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

namespace {

/// By its name, in small or capital letters.
base::Result<Profile> load_preset(const std::string& typed)
{
    std::string name = typed;
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    std::vector<std::string_view> names;
    for (const Preset& preset : presets()) {
        if (preset.name == name) {
            return parse_profile(preset.text, fmt::format("{}.toml", name), {});
        }
        names.push_back(preset.name);
    }
    return base::fail(fmt::format("there is neither a file nor a preset '{}': {}", typed,
                                  suggestion(name, names)));
}

} // namespace

std::string path_beside(const std::string& name, const std::string& beside)
{
    if (beside.empty()) return name;
    return (std::filesystem::path{beside}.parent_path() / name).string();
}

base::Result<Profile> load_profile(const std::string& file_or_name)
{
    std::error_code trouble;
    const bool is_file = file_or_name.find('/') != std::string::npos ||
                         file_or_name.ends_with(".toml") ||
                         std::filesystem::exists(file_or_name, trouble);
    if (!is_file) return load_preset(file_or_name);
    const auto text = net::text_of_file(file_or_name);
    if (!text) return tl::unexpected{text.error()};
    return parse_profile(*text, file_or_name, [&](const std::string& name) {
        return net::text_of_file(path_beside(name, file_or_name));
    });
}

} // namespace hapnet::emulator
