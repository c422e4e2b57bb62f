// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/profile_source.hpp"

#include "emulator/presets.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <vector>

namespace hapnet::emulator {

base::Result<std::string> read_text(const std::string& file)
{
    constexpr std::size_t bytes_max = 64 << 20;
    constexpr std::size_t chunk = 64 << 10;
    const auto refused = [&] {
        return base::fail(fmt::format("{}: {}", file, std::generic_category().message(errno)));
    };
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened{std::fopen(file.c_str(), "rb"),
                                                                 std::fclose};
    if (!opened) return refused();
    std::string text;
    while (text.size() <= bytes_max) {
        const std::size_t had = text.size();
        text.resize(had + chunk);
        const std::size_t got = std::fread(text.data() + had, 1, chunk, opened.get());
        text.resize(had + got);
        if (got == chunk) continue;
        if (std::ferror(opened.get()) != 0) return refused();
        return text;
    }
    return base::fail(fmt::format("{}: larger than 64 MiB", file));
}

OpenFile files_beside(const std::string& file)
{
    return [folder = std::filesystem::path{file}.parent_path()](const std::string& name) {
        return read_text((folder / name).string());
    };
}

base::Result<Profile> load_profile(const std::string& file_or_name)
{
    if (file_or_name.find_first_of("/.") != std::string::npos) {
        const auto text = read_text(file_or_name);
        if (!text) return base::fail(text.error().message);
        return parse_profile(*text, file_or_name, files_beside(file_or_name));
    }
    const auto all = presets();
    const auto preset = std::find_if(all.begin(), all.end(),
                                     [&](const Preset& one) { return one.name == file_or_name; });
    if (preset != all.end()) {
        return parse_profile(preset->text, fmt::format("{}.toml", preset->name), {});
    }
    std::vector<std::string_view> names;
    for (const Preset& one : all) names.push_back(one.name);
    return base::fail(
        fmt::format("there is no profile '{0}': {1} (a file is written with its path, "
                    "./{0}.toml)",
                    file_or_name, suggestion(file_or_name, names)));
}

std::string preset_list()
{
    std::string list;
    for (const Preset& preset : presets()) list += fmt::format("{}\n", preset.name);
    return list;
}

} // namespace hapnet::emulator
