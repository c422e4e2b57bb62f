// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/profile_file.hpp"

#include "emulator/core/profile/presets.hpp"
#include "emulator/core/profile/text.hpp"
#include "proto/base/built_in.hpp"
#include "proto/net/text_file.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <system_error>

namespace hapnet::emulator {

namespace {

/// Returns the name of a preset, which may be typed in capital letters. Returns any other name
/// unchanged.
std::string meant_name(const std::string& typed)
{
    std::string name = typed;
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return std::ranges::find(presets(), name, &Preset::name) == presets().end() ? typed : name;
}

/// Returns the beginning of an error that an option has caused.
std::string before(std::string_view option)
{
    return option.empty() ? "" : fmt::format("{}: ", option);
}

} // namespace

std::string path_beside(const std::string& name, const std::string& beside)
{
    if (beside.empty()) return name;
    return (std::filesystem::path{beside}.parent_path() / name).string();
}

base::Result<std::string> text_beside(const std::string& name, const std::string& beside)
{
    const auto path = path_beside(name, beside);
    std::error_code trouble;
    if (std::filesystem::exists(path, trouble) &&
        !std::filesystem::is_regular_file(path, trouble)) {
        return base::fail(fmt::format("{} is not a regular file", path));
    }
    return net::text_of_file(path);
}

std::string preset_list(char separator)
{
    std::string list;
    for (const Preset& preset : presets()) list += std::string{preset.name} + separator;
    return list;
}

base::Result<std::string> preset_text(const std::string& name)
{
    const auto no_file = [](const std::string& path) -> base::Result<std::string> {
        return base::fail("cannot read " + path);
    };
    return base::find_text(meant_name(name), presets(), "a preset", no_file)
        .map([](const auto& found) { return std::string{found.text}; });
}

base::Result<Profile> load_profile(const std::string& file_or_name, const PathNames& names,
                                   std::string_view option)
{
    const auto found =
        base::find_text(meant_name(file_or_name), presets(), "a preset", net::text_of_file);
    if (!found) {
        return base::fail(fmt::format("{}{}", before(option), found.error().message));
    }
    const auto open = [&](const std::string& name) {
        return net::text_of_file(path_beside(name, found->source));
    };
    return parse_profile(found->text, found->source, open, names);
}

} // namespace hapnet::emulator
