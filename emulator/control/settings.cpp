// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/control/settings.hpp"

#include "emulator/core/profile/settings.hpp"

#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

/// What the settings say one way; `after` are the conditions once they hold.
Patch patch_of(Direction direction, const std::vector<Setting>& settings, const Conditions& after)
{
    Patch patch;
    bool sets_bursts = false;
    const auto add = [&](const Setting& setting) {
        patch = merged(std::move(patch), setting.settings.patch);
        sets_bursts = sets_bursts || setting.settings.burst_loss;
    };
    for (const Setting& setting : settings) {
        if (!setting.direction) add(setting);
    }
    for (const Setting& setting : settings) {
        if (setting.direction == direction) add(setting);
    }
    if (sets_bursts) patch.loss = after.loss;
    return patch;
}

/// As a person writes it: "80ms" for a text, anything else as in a profile.
std::string unquoted(const std::string& toml)
{
    const bool is_plain_text = toml.size() >= 2 && toml.front() == '"' && toml.back() == '"' &&
                               toml.find_first_of("\"\\", 1) == toml.size() - 1;
    return is_plain_text ? toml.substr(1, toml.size() - 2) : toml;
}

} // namespace

base::Result<Set> set_of(const SetRequest& request, const Path& path, const OpenFile& open)
{
    std::vector<Setting> settings;
    for (const auto& [key, value] : request.settings) {
        auto setting = parse_setting(key, value, open);
        if (!setting) return tl::unexpected{setting.error()};
        settings.push_back(*std::move(setting));
    }
    const auto after = with_settings(path, settings);
    if (!after) return tl::unexpected{after.error()};
    return Set{patch_of(Direction::up, settings, after->up),
               patch_of(Direction::down, settings, after->down), request.lasting};
}

std::vector<SettingText> texts_of(Direction direction, const Patch& patch)
{
    std::vector<SettingText> texts;
    const auto values = setting_texts(patch);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!values[i]) continue;
        texts.emplace_back(fmt::format("{}.{}", to_text(direction), setting_keys[i]),
                           unquoted(*values[i]));
    }
    return texts;
}

std::vector<Difference> differences(const Path& from, const Path& to)
{
    std::vector<Difference> found;
    for (const Direction direction : {Direction::up, Direction::down}) {
        const bool is_up = direction == Direction::up;
        const auto before = setting_texts(to_patch(is_up ? from.up : from.down));
        const auto after = setting_texts(to_patch(is_up ? to.up : to.down));
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (before[i] == after[i]) continue;
            found.push_back({fmt::format("{}.{}", to_text(direction), setting_keys[i]),
                             unquoted(before[i].value_or("none")),
                             unquoted(after[i].value_or("none"))});
        }
    }
    return found;
}

} // namespace hapnet::emulator
