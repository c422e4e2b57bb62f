// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/regimes.hpp"

#include "emulator/core/flow/flow.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/settings.hpp"
#include "proto/base/fields.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

/// Reads the conditions that the keys of a regime set.
Patch read_conditions_of(TableReader& table)
{
    DirectionSettings settings;
    for (const std::string_view key : regime_keys) {
        if (const Node* value = table.find(key)) {
            read_setting(key, *value, settings, table.reading());
        }
    }
    return std::move(settings.patch);
}

Regime read_regime(const Node& node, Reading& reading)
{
    Regime regime;
    const auto* entries = std::get_if<Node::Table>(&node.value);
    if (entries == nullptr) {
        reading.complain(node.place, "expected a table with a name and a stay: [[up.regime]]");
        return regime;
    }
    TableReader table{*entries, node.place, reading};
    base::read_fields(table, regime);
    regime.own = read_conditions_of(table);
    table.finish();
    return regime;
}

std::string regime_text(const Regime& regime)
{
    auto texts = base::field_texts(regime, base::Print::needed);
    const SettingTexts settings = setting_texts(regime.own);
    for (std::size_t i = 0; i < settings.size(); ++i) {
        if (settings[i]) texts.push_back(fmt::format("{} = {}", setting_keys[i], *settings[i]));
    }
    return table_text(texts);
}

/// Returns the names of the regimes that set the setting `key`.
std::vector<std::string> setters_of(std::string_view key, const Regimes& regimes)
{
    std::vector<std::string> names;
    for (const Regime& regime : regimes.all) {
        for_each_setting([&](const auto& slot) {
            if (slot.key == key && regime.own.*slot.patch) names.push_back(regime.name);
        });
    }
    return names;
}

} // namespace

void RegimeNameFormat::read(const base::Node& node, std::string& target,
                            base::Reading& reading) const
{
    std::string name;
    base::read_value(node, name, reading);
    if (!reading.is_good()) return;
    if (const auto valid = validate_name(name, "regime"); !valid) {
        return reading.complain(node.place, valid.error().message);
    }
    target = std::move(name);
}

void WeightsFormat::read(const base::Node& node, Weights& target, base::Reading& reading) const
{
    const auto* entries = std::get_if<base::Node::Table>(&node.value);
    if (entries == nullptr) return base::complain_of(node, describe(), reading);
    Weights weights;
    for (const base::Entry& entry : *entries) {
        const auto* whole = std::get_if<std::int64_t>(&entry.value.value);
        const auto* real = std::get_if<double>(&entry.value.value);
        if (whole == nullptr && real == nullptr) {
            return base::complain_of(entry.value, "a number, the weight of a regime", reading);
        }
        weights.emplace_back(entry.key, real != nullptr ? *real : static_cast<double>(*whole));
    }
    target = std::move(weights);
}

std::string WeightsFormat::print(const Weights& value) const
{
    if (value.empty()) return "{}";
    std::vector<std::string> texts;
    for (const auto& [name, weight] : value) {
        texts.push_back(fmt::format("{} = {}", name, base::value_text(weight)));
    }
    return base::table_text(texts);
}

base::SharedVector<Regime> read_regimes(const Node& node, Reading& reading)
{
    const auto* text = std::get_if<std::string>(&node.value);
    if (text != nullptr && *text == "none") return {};
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list == nullptr) {
        reading.complain(node.place, "write regimes as [[up.regime]], each with a name and a stay");
        return {};
    }
    std::vector<Regime> all;
    for (const Node& element : *list) all.push_back(read_regime(element, reading));
    if (all.empty()) return {};
    Regimes regimes{std::move(all)};
    if (!reading.is_good()) return {};
    if (const auto valid = validate(regimes); !valid) {
        reading.complain(node.place, valid.error().message);
    }
    return regimes.all;
}

std::vector<RegimePatch> read_regime_patches(const Node& node, Reading& reading)
{
    std::vector<RegimePatch> patches;
    for (const base::Entry& entry : std::get<Node::Table>(node.value)) {
        const auto* entries = std::get_if<Node::Table>(&entry.value.value);
        if (entries == nullptr) {
            reading.complain(entry.value.place, "expected conditions of a regime by its name: "
                                                "up.regime.bad.delay");
            continue;
        }
        TableReader table{*entries, entry.value.place, reading};
        patches.push_back({entry.key, read_conditions_of(table)});
        table.finish();
    }
    return patches;
}

std::string regimes_text(const Regimes& regimes)
{
    std::vector<std::string> texts;
    for (const Regime& regime : regimes.all) texts.push_back(regime_text(regime));
    return fmt::format("[{}]", base::list_text(texts));
}

base::Result<Regimes> with_patch(const Regimes& regimes, const RegimePatch& patch)
{
    std::vector<Regime> all = regimes.all.get();
    const auto found = std::ranges::find(all, patch.regime, &Regime::name);
    if (found == all.end()) {
        const auto names = regime_names(regimes);
        const std::vector<std::string_view> known{names.begin(), names.end()};
        return base::fail(fmt::format("there is no regime {}: {}", base::in_quotes(patch.regime),
                                      known.empty() ? "a profile describes them by [[up.regime]]"
                                                    : base::suggestion(patch.regime, known)));
    }
    found->own = merged(std::move(found->own), patch.own);
    return Regimes{std::move(all), regimes.are_together};
}

base::Result<void> ensure_own(const Patch& patch, const Regimes& regimes, std::string_view way)
{
    base::Result<void> own;
    for_each_setting([&](const auto& slot) {
        if (!own || !(patch.*slot.patch)) return;
        const auto names = setters_of(slot.key, regimes);
        if (names.empty()) return;
        std::vector<std::string> keys;
        for (const std::string& name : names) {
            keys.push_back(fmt::format("{}regime.{}.{}", way, name, slot.key));
        }
        own = base::fail(fmt::format("{0}{1}: the regimes set the {1} ({2}): write {3}", way,
                                     slot.key, fmt::join(names, ", "), fmt::join(keys, " or ")));
    });
    return own;
}

NamesOfRegimes names_of_regimes(const Path& path)
{
    return {regime_names(path.up.regimes), regime_names(path.down.regimes)};
}

bool has_regimes(const Profile& profile)
{
    const auto sets_some = [](const Patch& patch) {
        return patch.regimes && !patch.regimes->empty();
    };
    return !profile.path.up.regimes.empty() || !profile.path.down.regimes.empty() ||
           std::ranges::any_of(profile.paths, [&](const PathPatch& own) {
               return sets_some(own.up) || sets_some(own.down);
           });
}

std::function<NamesOfRegimes(const std::string& path)> regimes_of_paths(const Profile& profile)
{
    if (!has_regimes(profile)) return {};
    return [profile](const std::string& path) {
        return names_of_regimes(profile_of(profile, path).path);
    };
}

base::Result<void> ensure_same_regimes(const Path& path, const Path& now)
{
    const NamesOfRegimes names = names_of_regimes(path);
    const NamesOfRegimes before = names_of_regimes(now);
    const auto in_words = [](const RegimeNames& all) {
        return all.empty() ? std::string{"none"} : fmt::format("{}", fmt::join(all, ", "));
    };
    for (const std::size_t way : {0U, 1U}) {
        if (names[way] == before[way]) continue;
        return base::fail(fmt::format("the regimes of a run cannot change: {} there are {}, and "
                                      "not {}. Name the same in the same order, or start again",
                                      way == 0 ? "up" : "down", in_words(before[way]),
                                      in_words(names[way])));
    }
    return {};
}

} // namespace hapnet::emulator
