// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/text.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

/// The value of an option: a text without quotes, or a table or list as it stands in a profile.
tl::expected<Node, DocumentError> parse_value(std::string_view value)
{
    if (!value.starts_with('{') && !value.starts_with('[')) return Node{{}, std::string{value}};
    auto document = parse_document(fmt::format("value = {}", value));
    if (!document) return document;
    auto& table = std::get<Node::Table>(document->value);
    // "{} \n more = 1" would be several.
    if (table.size() != 1) return tl::unexpected{DocumentError{{}, "more than one value"}};
    return std::move(table.front().value);
}

void add_bursts(std::vector<LossLaw>& laws, const std::vector<LossLaw>& bursts)
{
    std::erase_if(laws, [](const LossLaw& law) {
        const auto* burst = std::get_if<Burst>(&law);
        return burst != nullptr && !burst->phase;
    });
    laws.insert(laws.end(), bursts.begin(), bursts.end());
}

template <typename Use>
void for_each_of(Path& path, std::optional<Direction> direction, Use use)
{
    if (direction != Direction::down) use(path.up);
    if (direction != Direction::up) use(path.down);
}

} // namespace

base::Result<Setting> parse_setting(std::string_view key, std::string_view value,
                                    const OpenFile& open)
{
    Reading reading{std::string{key}, open, false};
    Setting setting;
    std::string name{key};
    const auto take = [&](std::string_view prefix) {
        if (!name.starts_with(prefix)) return false;
        name.erase(0, prefix.size());
        return true;
    };
    if (take("up.")) {
        setting.direction = Direction::up;
    } else if (take("down.")) {
        setting.direction = Direction::down;
    } else {
        take("both.");
    }
    std::replace(name.begin(), name.end(), '-', '_');
    if (std::find(setting_keys.begin(), setting_keys.end(), name) == setting_keys.end()) {
        return base::fail(
            fmt::format("{}: there is no such setting: {}", key, suggestion(name, setting_keys)));
    }
    const auto node = parse_value(value);
    if (!node) return base::fail(fmt::format("{}: {}", key, node.error().message));
    read_setting(name, *node, setting.settings, reading);
    if (!reading.is_good()) return base::fail(*reading.complaint());
    return setting;
}

base::Result<Path> with_settings(Path path, std::span<const Setting> settings)
{
    const auto in_turn = [&](auto use) {
        for (const bool is_of_both : {true, false}) {
            for (const Setting& setting : settings) {
                if (!setting.direction.has_value() == is_of_both) use(setting);
            }
        }
    };
    in_turn([&](const Setting& setting) {
        for_each_of(path, setting.direction, [&](Conditions& conditions) {
            conditions = patched(std::move(conditions), setting.settings.patch);
        });
    });
    in_turn([&](const Setting& setting) {
        if (!setting.settings.burst_loss) return;
        for_each_of(path, setting.direction, [&](Conditions& conditions) {
            add_bursts(conditions.loss, *setting.settings.burst_loss);
        });
    });
    if (std::max(path.up.loss.size(), path.down.loss.size()) > loss_laws_max) {
        return base::fail(fmt::format("a direction has at most {} laws of loss", loss_laws_max));
    }
    return path;
}

} // namespace hapnet::emulator
