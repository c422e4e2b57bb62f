// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/control/settings.hpp"

#include "emulator/core/profile/settings.hpp"

#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

/// Returns the setting as a person writes it: "80ms" for a text, anything else as in a profile.
std::string unquoted(const std::string& toml)
{
    const bool is_plain_text = toml.size() >= 2 && toml.front() == '"' && toml.back() == '"' &&
                               toml.find_first_of("\"\\", 1) == toml.size() - 1;
    return is_plain_text ? toml.substr(1, toml.size() - 2) : toml;
}

} // namespace

base::Result<std::vector<Setting>> settings_of(const SetRequest& request, const OpenFile& open,
                                               const PathNames& names)
{
    std::vector<Setting> settings;
    for (const auto& [key, value] : request.settings) {
        auto setting = parse_setting(key, value, open, names);
        if (!setting) return tl::unexpected{setting.error()};
        settings.push_back(*std::move(setting));
    }
    return settings;
}

base::Result<Set> set_of(std::span<const Setting> settings, std::optional<base::Duration> lasting,
                         std::string_view name, const Path& path)
{
    const auto after = with_settings(path, settings, name);
    if (!after) return tl::unexpected{after.error()};
    for (const auto& fine :
         {ensure_same_regimes(*after, path), ensure_own_settings(settings, name, *after)}) {
        if (!fine) return tl::unexpected{fine.error()};
    }
    return Set{patch_of(settings, name, Direction::up, after->up),
               patch_of(settings, name, Direction::down, after->down), lasting};
}

std::vector<SettingText> texts_of(Direction direction, const Patch& patch, std::string_view path)
{
    std::vector<SettingText> texts;
    const auto values = setting_texts(patch);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!values[i]) continue;
        texts.emplace_back(fmt::format("{}.{}", way_name(path, direction), setting_keys[i]),
                           unquoted(*values[i]));
    }
    return texts;
}

std::vector<Difference> differences(const Path& from, const Path& to, std::string_view path)
{
    std::vector<Difference> found;
    for (const Direction direction : {Direction::up, Direction::down}) {
        const bool is_up = direction == Direction::up;
        const auto before = setting_texts(to_patch(is_up ? from.up : from.down));
        const auto after = setting_texts(to_patch(is_up ? to.up : to.down));
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (before[i] == after[i]) continue;
            found.push_back({fmt::format("{}.{}", way_name(path, direction), setting_keys[i]),
                             unquoted(before[i].value_or("none")),
                             unquoted(after[i].value_or("none"))});
        }
    }
    return found;
}

} // namespace hapnet::emulator
