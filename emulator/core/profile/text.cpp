// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/text.hpp"

#include "emulator/core/profile/timeline.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

/// A setting of a profile and where it stands.
struct Placed {
    Setting setting;
    Place place;
};

/// The tables both, up and down, where they are.
std::vector<Placed> read_directions(TableReader& table)
{
    std::vector<Placed> all;
    const auto read = [&](std::string_view key, std::optional<Direction> direction) {
        const Node* node = table.find(key);
        if (node == nullptr) return;
        all.push_back({{direction, read_direction(*node, table.reading())}, node->place});
    };
    read("both", std::nullopt);
    read("up", Direction::up);
    read("down", Direction::down);
    return all;
}

Path read_path(TableReader& table)
{
    std::vector<Setting> settings;
    Place place = table.place();
    for (Placed& placed : read_directions(table)) {
        settings.push_back(std::move(placed.setting));
        place = placed.place;
    }
    auto path = with_settings({}, settings);
    if (!path) table.reading().complain(place, path.error().message);
    return path.value_or(Path{});
}

void read_time(const Node* node, base::Duration& target, Reading& reading)
{
    if (node == nullptr) return;
    read_value(*node, target, reading);
    if (target < base::Duration{0}) reading.complain(node->place, "a time cannot be negative");
}

struct PlacedChange {
    Change change;
    Place place;
    Place ramp_place;
};

PlacedChange read_change(const Node& node, Reading& reading)
{
    PlacedChange placed{{}, node.place, node.place};
    const auto* entries = std::get_if<Node::Table>(&node.value);
    if (entries == nullptr) {
        reading.complain(node.place, "expected a table with a time: [[at]]");
        return placed;
    }
    TableReader table{*entries, node.place, reading};
    read_time(table.require("time", "write time = \"10s\""), placed.change.time, reading);
    const Node* ramp = table.find("ramp");
    read_time(ramp, placed.change.ramp, reading);
    if (ramp != nullptr) placed.ramp_place = ramp->place;
    for (const Placed& side : read_directions(table)) {
        const DirectionSettings& settings = side.setting.settings;
        Patch patch = settings.patch;
        if (settings.burst_loss && !patch.loss) {
            reading.complain(side.place, "a change sets all laws of loss at once: write loss = "
                                         "[\"5%\", \"40/100\"] instead of burst_loss");
        } else if (settings.burst_loss) {
            patch.loss->insert(patch.loss->end(), settings.burst_loss->begin(),
                               settings.burst_loss->end());
            if (patch.loss->size() > loss_laws_max) {
                reading.complain(
                    side.place,
                    fmt::format("a direction can have at most {} laws of loss", loss_laws_max));
            }
        }
        const auto direction = side.setting.direction;
        if (direction != Direction::down) placed.change.up = merged(placed.change.up, patch);
        if (direction != Direction::up) placed.change.down = merged(placed.change.down, patch);
    }
    table.finish();
    return placed;
}

void read_timeline(const Node* node, Profile& profile, Reading& reading)
{
    if (node == nullptr) return;
    const auto* list = std::get_if<Node::List>(&node->value);
    if (list == nullptr) {
        return reading.complain(node->place, "write changes as [[at]]");
    }
    if (list->size() > changes_max) {
        return reading.complain(node->place,
                                fmt::format("a timeline can have at most {} changes", changes_max));
    }
    std::vector<PlacedChange> placed;
    for (const Node& element : *list) placed.push_back(read_change(element, reading));
    std::stable_sort(placed.begin(), placed.end(),
                     [](const auto& a, const auto& b) { return a.change.time < b.change.time; });
    for (const PlacedChange& one : placed) profile.timeline.push_back(one.change);
    if (!reading.is_good()) return;
    if (const auto valid = Timeline::validate(profile); !valid) {
        reading.complain(placed[valid.error().index].ramp_place, valid.error().message);
    }
}

void read_checks(const Node* node, Profile& profile, Reading& reading)
{
    if (node == nullptr) return;
    const auto* list = std::get_if<Node::List>(&node->value);
    if (list == nullptr) return reading.complain(node->place, "write checks as [[check]]");
    if (list->size() > checks_max) {
        return reading.complain(node->place,
                                fmt::format("a profile can have at most {} checks", checks_max));
    }
    for (const Node& element : *list) {
        const auto* entries = std::get_if<Node::Table>(&element.value);
        if (entries == nullptr) {
            reading.complain(element.place, "expected a table with a condition: [[check]]");
            continue;
        }
        TableReader table{*entries, element.place, reading};
        std::string text;
        const Node* require = table.require("require", "write require = \"up.received>=1000\"");
        if (require != nullptr) read_value(*require, text, reading);
        table.finish();
        if (!reading.is_good()) return;
        const auto condition = base::parse_condition(text);
        if (!condition) return reading.complain(require->place, condition.error().message);
        profile.checks.push_back(*condition);
    }
}

std::optional<base::Seed> read_seed(const Node* node, Reading& reading)
{
    if (node == nullptr) return std::nullopt;
    if (const auto* integer = std::get_if<std::int64_t>(&node->value); integer && *integer >= 0) {
        return base::Seed{static_cast<std::uint64_t>(*integer)};
    }
    // TOML has no larger whole numbers than 2^63 - 1; a seed may be larger.
    if (const auto* text = std::get_if<std::string>(&node->value)) {
        const auto seed = base::parse_count(*text, std::numeric_limits<std::uint64_t>::max());
        if (seed) return base::Seed{*seed};
    }
    reading.complain(node->place, "a seed must be a whole number from 0 to 2^64 - 1");
    return std::nullopt;
}

/// What both say alike.
SettingTexts common(const SettingTexts& a, const SettingTexts& b)
{
    SettingTexts texts;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] == b[i]) texts[i] = a[i];
    }
    return texts;
}

void print(std::string& out, const SettingTexts& texts, const SettingTexts& but,
           const std::string& prefix)
{
    for (std::size_t i = 0; i < texts.size(); ++i) {
        if (!texts[i] || but[i]) continue;
        out += fmt::format("{}{} = {}\n", prefix, setting_keys[i], *texts[i]);
    }
}

void print_section(std::string& out, const std::string& name, const SettingTexts& texts,
                   const SettingTexts& but)
{
    std::string lines;
    print(lines, texts, but, "");
    if (!lines.empty()) out += fmt::format("\n[{}]\n{}", name, lines);
}

/// The steps that are left of a timeline lie anywhere: 18.482486886s, not 18482486886ns.
std::string time_text(base::Duration time)
{
    constexpr base::Duration second = std::chrono::seconds{1};
    constexpr base::Duration millisecond = std::chrono::milliseconds{1};
    if (time < second || time % millisecond == base::Duration{0}) return value_text(time);
    auto text = fmt::format("{}.{:09}", time / second, (time % second).count());
    text.erase(text.find_last_not_of('0') + 1);
    return base::quoted(text + "s");
}

void print_change(std::string& out, const Change& change)
{
    out += fmt::format("\n[[at]]\ntime = {}\n", time_text(change.time));
    if (change.ramp > base::Duration{0}) {
        out += fmt::format("ramp = {}\n", value_text(change.ramp));
    }
    const SettingTexts up = setting_texts(change.up);
    const SettingTexts down = setting_texts(change.down);
    const SettingTexts both = common(up, down);
    print(out, both, {}, "both.");
    print(out, up, both, "up.");
    print(out, down, both, "down.");
}

} // namespace

base::Result<Profile> parse_profile(std::string_view text, const std::string& source,
                                    const OpenFile& open)
{
    Reading reading{source, open};
    const auto document = parse_document(text);
    if (!document) {
        reading.complain(document.error().place, document.error().message);
        return base::fail(*reading.complaint());
    }
    TableReader table{std::get<Node::Table>(document->value), document->place, reading};
    Profile profile;
    const Node* name = table.find("name");
    if (name != nullptr) read_value(*name, profile.name, reading);
    profile.seed = read_seed(table.find("seed"), reading);
    profile.path = read_path(table);
    read_timeline(table.find("at"), profile, reading);
    read_checks(table.find("check"), profile, reading);
    table.finish();
    if (!reading.is_good()) return base::fail(*reading.complaint());
    return profile;
}

std::string to_text(const Profile& profile)
{
    constexpr std::uint64_t largest_integer = std::numeric_limits<std::int64_t>::max();
    std::string out;
    if (!profile.name.empty()) out += fmt::format("name = {}\n", base::quoted(profile.name));
    if (profile.seed) {
        const auto seed = fmt::format("{}", profile.seed->value());
        out += fmt::format("seed = {}\n",
                           profile.seed->value() > largest_integer ? base::quoted(seed) : seed);
    }
    const SettingTexts up = setting_texts(to_patch(profile.path.up));
    const SettingTexts down = setting_texts(to_patch(profile.path.down));
    const SettingTexts both = common(up, down);
    print_section(out, "both", both, {});
    print_section(out, "up", up, both);
    print_section(out, "down", down, both);
    for (const Change& change : profile.timeline) print_change(out, change);
    for (const base::Condition& check : profile.checks) {
        out += fmt::format("\n[[check]]\nrequire = {}\n", base::quoted(to_text(check)));
    }
    return out;
}

} // namespace hapnet::emulator
