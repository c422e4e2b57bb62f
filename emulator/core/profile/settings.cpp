// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/settings.hpp"

#include "emulator/core/profile/flows.hpp"
#include "emulator/core/profile/laws.hpp"
#include "emulator/core/profile/setting_hints.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/fields.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

/// The values of the key `regimes`: the regimes of both directions change together, or
/// independently.
constexpr std::string_view together = "together";
constexpr std::string_view apart = "apart";

/// A key of the rate; a trace has none.
constexpr std::string_view limit_key = "limit";

/// Reads "none", the short form of the first parameter, or a table.
template <typename Stage>
Stage read_stage(const Node& node, Reading& reading)
{
    Stage stage;
    const auto* text = std::get_if<std::string>(&node.value);
    if (text != nullptr && *text == "none") return stage;
    if (std::holds_alternative<Node::Table>(node.value)) {
        base::read_table(node, stage, reading);
    } else {
        base::read_field(base::field_table<Stage>().rows.front(), node, &stage, reading);
    }
    if (const auto valid = validate(stage); !valid) {
        reading.complain(node.place, valid.error().message);
    }
    return stage;
}

/// Lets a token bucket call its limit "mean", as tc and traffic contracts do.
Node with_limit_for_mean(Node node, Reading& reading)
{
    auto& entries = std::get<Node::Table>(node.value);
    const auto mean = std::ranges::find(entries, "mean", &base::Entry::key);
    if (mean == entries.end()) return node;
    if (std::ranges::find(entries, limit_key, &base::Entry::key) != entries.end()) {
        reading.complain(mean->place, "mean and limit say the same: write one of them");
    }
    if (std::ranges::find(entries, "burst", &base::Entry::key) == entries.end()) {
        reading.complain(mean->place, "mean goes with burst: write limit for a rate without one");
    }
    mean->key = limit_key;
    return node;
}

/// Reads a rate, or a table with a constant rate, or { law = "trace", file = ... } with the other
/// keys.
Rate read_rate(const Node& node, Reading& reading)
{
    if (!std::holds_alternative<Node::Table>(node.value)) return read_stage<Rate>(node, reading);
    const Node table_node = with_limit_for_mean(node, reading);
    const auto* entries = std::get_if<Node::Table>(&table_node.value);
    TableReader table{*entries, node.place, reading};
    const Node* law = table.find("law");
    if (law == nullptr) return read_stage<Rate>(table_node, reading);
    Rate rate;
    std::string name;
    read_value(*law, name, reading);
    const auto known = base::described_name<RateTraceLaw>;
    if (reading.is_good() && name != known) {
        reading.complain(law->place, fmt::format("unknown law {}: use {}, or limit without a law",
                                                 base::in_quotes(name), known));
    }
    base::read_fields(table, rate.trace.emplace());
    for (const base::FieldRow& row : base::field_table<Rate>().rows) {
        const Node* value = row.key == limit_key ? nullptr : table.find(row.key);
        if (value != nullptr) base::read_field(row, *value, &rate, reading);
    }
    table.finish();
    const auto loaded = reading.is_good() ? rate.trace->load(reading) : base::Result<void>{};
    if (!loaded) reading.complain(node.place, loaded.error().message);
    const auto valid = reading.is_good() ? validate(rate) : base::Result<void>{};
    if (!valid) reading.complain(node.place, valid.error().message);
    return rate;
}

/// Returns the short form if it is complete, else a table.
template <typename Stage>
std::string stage_text(const Stage& stage)
{
    constexpr auto first = std::get<0>(base::description<Stage>.members);
    Stage as_short;
    as_short.*first.member = stage.*first.member;
    return stage == as_short ? *base::field_text(base::field_table<Stage>().rows.front(), &stage)
                             : table_text(base::field_texts(stage, base::Print::needed));
}

std::vector<LossLaw> read_burst_loss(const Node& node, Reading& reading)
{
    const auto* text = std::get_if<std::string>(&node.value);
    if (text != nullptr && *text == "none") return {};
    const Burst burst = read_burst(node, reading);
    if (burst.lost == 0 && burst.of > 0) return {};
    if (const auto valid = burst.validate(); !valid) {
        reading.complain(node.place, valid.error().message);
    }
    return {burst};
}

void contradict(const Node& node, Reading& reading)
{
    reading.complain(node.place, "jitter and order name different orders: write only one of them");
}

void read_jitter(const Node& node, Patch& patch, Reading& reading)
{
    std::optional<Order> order;
    patch.jitter = read_variation(node, Role::jitter, order, reading);
    if (order && patch.order && *order != *patch.order) contradict(node, reading);
    if (order) patch.order = order;
}

/// Returns the values of a setting as TOML.
template <typename Stage>
std::string setting_text(const Stage& stage, std::string_view /*key*/)
{
    return stage_text(stage);
}
std::string setting_text(const std::vector<LossLaw>& laws, std::string_view /*key*/)
{
    return losses_text(laws);
}
std::string setting_text(const Variation& variation, std::string_view key)
{
    return variation_text(variation, key == "delay" ? Role::delay : Role::jitter);
}
std::string setting_text(const Rate& rate, std::string_view /*key*/)
{
    if (!rate.trace) return stage_text(rate);
    auto texts = base::field_texts(*rate.trace, base::Print::needed);
    texts.insert(texts.begin(),
                 "law = " + std::string{base::quoted(base::described_name<RateTraceLaw>)});
    for (const std::string& text : base::field_texts(rate, base::Print::needed)) {
        if (!text.starts_with(limit_key)) texts.push_back(text);
    }
    return table_text(texts);
}
std::string setting_text(Order order, std::string_view /*key*/)
{
    return base::quoted(to_text(order));
}
std::string setting_text(const Reordering& reordering, std::string_view /*key*/)
{
    return reordering == Reordering{} ? base::quoted("none") : stage_text(reordering);
}

void read_correlation_time(const Node& node, DirectionSettings& settings, Reading& reading)
{
    base::Duration time{};
    read_value(node, time, reading);
    if (time < base::Duration{0}) reading.complain(node.place, "a time cannot be negative");
    settings.correlation_time = time;
}

std::string setting_text(const Regimes& regimes, std::string_view /*key*/)
{
    return regimes_text(regimes);
}

/// Reads the regimes. A list defines all of them; a table has conditions of existing ones.
void read_regime_setting(const Node& node, DirectionSettings& settings, Reading& reading)
{
    if (std::holds_alternative<Node::Table>(node.value)) {
        settings.of_regimes = read_regime_patches(node, reading);
    } else {
        settings.patch.regimes = Regimes{read_regimes(node, reading)};
    }
}

void read_togetherness(const Node& node, DirectionSettings& settings, Reading& reading)
{
    const auto* text = std::get_if<std::string>(&node.value);
    if (text == nullptr || (*text != together && *text != apart)) {
        return base::complain_of(node, fmt::format("\"{}\" or \"{}\"", together, apart), reading);
    }
    settings.are_together = *text == together;
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

/// The setting that a key names.
struct Target {
    Way way;
    std::string regime{}; // regime of the setting; empty: the direction itself
    std::string name;     // one of setting_keys
};

/// Removes "regime.NAME" from the end of `front`, and returns the name; "": `front` does not end
/// like that.
std::string_view take_regime(std::string_view& front)
{
    constexpr std::string_view word = "regime.";
    const auto dot = front.rfind('.');
    if (dot == std::string_view::npos) return "";
    const auto name = front.substr(dot + 1);
    const auto before = front.substr(0, dot + 1);
    const auto way = parse_way(name);
    if (!before.ends_with(word) || (way && way->path.empty())) return "";
    const auto rest = before.substr(0, before.size() - word.size());
    if (!rest.empty() && !rest.ends_with('.')) return "";
    front = rest.substr(0, rest.size() - (rest.empty() ? 0 : 1));
    return name;
}

bool is_setting(std::string_view name)
{
    return std::find(setting_keys.begin(), setting_keys.end(), name) != setting_keys.end();
}

std::string with_underscores(std::string_view name)
{
    std::string text{name};
    std::replace(text.begin(), text.end(), '-', '_');
    return text;
}

/// Returns the error for a key with more parts than the names of a direction and a setting.
base::Result<Target> refusal_of_parts(std::string_view key, std::string_view front)
{
    const auto dot = front.rfind('.');
    const auto inner = dot == std::string_view::npos ? front : front.substr(dot + 1);
    if (is_setting(with_underscores(inner))) {
        return base::fail(
            fmt::format("{}: a setting is set as a whole: {} '{{ ... }}'", key, front));
    }
    return base::fail(fmt::format("{}: unknown direction '{}': use up, down or both", key,
                                  front.substr(0, front.find('.'))));
}

base::Result<Target> target_of(std::string_view key, const PathNames& names)
{
    if (key == "seed") {
        return base::fail("seed: the seed of a run cannot change: start the emulator with --seed");
    }
    const auto dot = key.rfind('.');
    const auto whole_front = dot == std::string_view::npos ? "" : key.substr(0, dot);
    auto front = whole_front;
    const auto regime = take_regime(front);
    const auto name = with_underscores(dot == std::string_view::npos ? key : key.substr(dot + 1));
    const auto way = parse_way(front);
    const bool can_be_many = !names.links.empty() || names.clients || names.any;
    const bool is_other =
        way && (is_pair(way->path) || is_of_commands(way->path) ||
                way->path.starts_with("client.") || !parts_of(way->path).flow.empty());
    if (!way || !(names.contains(way->path) || can_be_many || is_other)) {
        return refusal_of_parts(key, front);
    }
    if (!names.contains(way->path)) {
        return base::fail(fmt::format("{}: {}", key, names.refusal(way->path)));
    }
    if (!is_setting(name)) {
        const std::string_view in = whole_front.empty() ? "" : key.substr(0, dot + 1);
        if (const auto meant = base::nearest(name, setting_keys)) {
            return base::fail(
                fmt::format("unknown key '{}': did you mean '{}{}'?", key, in, *meant));
        }
        return base::fail(fmt::format("unknown key '{}': {}", key, suggestion(name, setting_keys)));
    }
    if (!regime.empty() && std::ranges::find(regime_keys, name) == regime_keys.end()) {
        return base::fail(fmt::format("{}: a regime sets {}; the rest is of the direction, and the "
                                      "course of the regimes is of the whole run",
                                      key, fmt::join(regime_keys, ", ")));
    }
    return Target{*way, std::string{regime}, name};
}

/// Returns true if the settings define regimes, tie both directions, or change a regime by name.
bool changes_regimes(const DirectionSettings& settings)
{
    return settings.patch.regimes || settings.are_together || !settings.of_regimes.empty();
}

/// Calls use(setting) for the settings for all paths and for the path of this name. If two
/// contradict each other, the one that wins comes last. A flow does not get the settings of the
/// other traffic, and the other traffic does not get those of a flow.
template <typename Use>
void in_turn(std::span<const Setting> settings, std::string_view path, const Use& use)
{
    const std::string_view common = common_name(path);
    for (const bool is_of_all : {true, false}) {
        for (const bool is_of_both : {true, false}) {
            for (const Setting& setting : settings) {
                if ((setting.path == common) != is_of_all) continue;
                if (!is_of_all && setting.path != path) continue;
                if (!setting.direction.has_value() == is_of_both) use(setting);
            }
        }
    }
}

/// Sets the regimes of the settings in `path`. `are_together`: the regimes of both directions
/// changed together before.
base::Result<void> set_regimes(Path& path, std::span<const Setting> settings, std::string_view name,
                               bool are_together)
{
    base::Result<void> done;
    in_turn(settings, name, [&](const Setting& setting) {
        if (setting.settings.are_together) {
            if (setting.direction) {
                done = base::fail("regimes goes with both directions: write it below [both]");
            }
            are_together = *setting.settings.are_together;
        }
        for (const RegimePatch& patch : setting.settings.of_regimes) {
            for_each_of(path, setting.direction, [&](Conditions& conditions) {
                auto with = with_patch(conditions.regimes, patch);
                if (!with) {
                    done = tl::unexpected{with.error()};
                } else {
                    conditions.regimes = *std::move(with);
                }
            });
        }
    });
    if (!done) return done;
    path.up.regimes.are_together = path.down.regimes.are_together = are_together;
    if (!are_together) return {};
    if (path.up.regimes.empty() && path.down.regimes.empty()) {
        return base::fail("regimes = \"together\" goes with regimes: write them as "
                          "[[both.regime]]");
    }
    if (have_same_course(path.up.regimes, path.down.regimes)) return {};
    return base::fail("regimes that change together have the same names, stays and weights both "
                      "ways: write them as [[both.regime]]");
}

} // namespace

void read_setting(std::string_view key, const Node& node, DirectionSettings& settings,
                  Reading& reading)
{
    Patch& patch = settings.patch;
    if (key == "mtu") {
        patch.mtu = read_stage<Mtu>(node, reading);
    } else if (key == "rate") {
        patch.rate = read_rate(node, reading);
    } else if (key == "queue") {
        patch.queue = read_stage<QueueControl>(node, reading);
    } else if (key == "loss") {
        patch.loss = read_losses(node, reading);
    } else if (key == "burst_loss") {
        settings.burst_loss = read_burst_loss(node, reading);
    } else if (key == "corrupt") {
        patch.corrupt = read_stage<Corruption>(node, reading);
    } else if (key == "duplicate") {
        patch.duplicate = read_stage<Duplication>(node, reading);
    } else if (key == "delay") {
        std::optional<Order> order;
        patch.delay = read_variation(node, Role::delay, order, reading);
        if (order) reading.complain(node.place, "order belongs to jitter, not to delay");
    } else if (key == "jitter") {
        read_jitter(node, patch, reading);
    } else if (key == "correlation_time") {
        read_correlation_time(node, settings, reading);
    } else if (key == "order") {
        const Order order = read_order(node, reading);
        if (patch.order && *patch.order != order) contradict(node, reading);
        patch.order = order;
    } else if (key == "reorder") {
        patch.reorder = read_stage<Reordering>(node, reading);
    } else if (key == "regime") {
        read_regime_setting(node, settings, reading);
    } else {
        base::ensure(key == "regimes");
        read_togetherness(node, settings, reading);
    }
}

Variation* correlated(Conditions& conditions)
{
    if (!is_nothing(conditions.jitter)) return &conditions.jitter;
    const bool varies = !std::holds_alternative<ConstantLaw>(conditions.delay.law);
    return varies ? &conditions.delay : nullptr;
}

DirectionSettings read_direction(const Node& node, Reading& reading)
{
    DirectionSettings settings;
    const auto* entries = std::get_if<Node::Table>(&node.value);
    if (entries == nullptr) {
        reading.complain(node.place, "expected a table of settings, such as [both]");
        return settings;
    }
    TableReader table{*entries, node.place, reading};
    for (const std::string_view key : setting_keys) {
        if (const Node* value = table.find(key)) read_setting(key, *value, settings, reading);
    }
    table.finish();
    return settings;
}

SettingTexts setting_texts(const Patch& patch)
{
    SettingTexts texts;
    for_each_setting([&](const auto& slot) {
        const auto& value = patch.*slot.patch;
        if (!value) return;
        const auto* const key = std::find(setting_keys.begin(), setting_keys.end(), slot.key);
        texts[static_cast<std::size_t>(key - setting_keys.begin())] =
            setting_text(*value, slot.key);
    });
    if (patch.regimes && patch.regimes->are_together) texts.back() = base::quoted(together);
    return texts;
}

base::Result<Setting> parse_setting(std::string_view key, std::string_view value,
                                    const OpenFile& open, const PathNames& names)
{
    Reading reading{std::string{key}, open, false};
    const auto target = target_of(key, names);
    if (!target) return tl::unexpected{target.error()};
    Setting setting{target->way.direction, {}, target->way.path};
    const std::string text = with_unit(target->name, value);
    const auto refuse = [&](const std::string& why) {
        return base::fail(fmt::format("{}: {}", key, explained(target->name, text, why)));
    };
    const auto node = base::parse_option(text, false);
    if (!node) return refuse(node.error().message);
    read_setting(target->name, *node, setting.settings, reading);
    // The error begins with the key, where an error in a file has the position.
    if (!reading.is_good()) return refuse(reading.complaint()->substr(key.size() + 2));
    if (const auto valid = validate_patch(setting.settings.patch, setting.path, names); !valid) {
        return base::fail(fmt::format("{}: {}", key, valid.error().message));
    }
    if (!target->regime.empty()) {
        RegimePatch of_regime{target->regime, std::exchange(setting.settings.patch, {})};
        setting.settings.of_regimes.push_back(std::move(of_regime));
    }
    return setting;
}

base::Result<Path> with_settings(Path path, std::span<const Setting> settings,
                                 std::string_view name)
{
    const bool were_together = path.up.regimes.are_together;
    in_turn(settings, name, [&](const Setting& setting) {
        for_each_of(path, setting.direction, [&](Conditions& conditions) {
            conditions = patched(std::move(conditions), setting.settings.patch);
        });
    });
    in_turn(settings, name, [&](const Setting& setting) {
        if (!setting.settings.burst_loss) return;
        for_each_of(path, setting.direction, [&](Conditions& conditions) {
            add_bursts(conditions.loss, *setting.settings.burst_loss);
        });
    });
    bool is_one_lacking = false;
    in_turn(settings, name, [&](const Setting& setting) {
        if (!setting.settings.correlation_time) return;
        bool is_used = false;
        for_each_of(path, setting.direction, [&](Conditions& conditions) {
            Variation* const target = correlated(conditions);
            is_used = is_used || target != nullptr;
            if (target != nullptr) target->correlation_time = *setting.settings.correlation_time;
        });
        is_one_lacking = is_one_lacking || !is_used;
    });
    if (is_one_lacking) return base::fail(std::string{nothing_to_correlate});
    auto set = set_regimes(path, settings, name, were_together);
    if (!set) return tl::unexpected{set.error()};
    if (std::max(path.up.loss.size(), path.down.loss.size()) > loss_laws_max) {
        return base::fail(
            fmt::format("a direction can have at most {} laws of loss", loss_laws_max));
    }
    return path;
}

base::Result<void> ensure_own_settings(std::span<const Setting> settings, std::string_view name,
                                       const Path& path)
{
    base::Result<void> own;
    in_turn(settings, name, [&](const Setting& setting) {
        Patch patch = setting.settings.patch;
        if (setting.settings.burst_loss) patch.loss = setting.settings.burst_loss;
        for (const Direction direction : {Direction::up, Direction::down}) {
            const bool is_up = direction == Direction::up;
            if (!own || (setting.direction && *setting.direction != direction)) continue;
            own = ensure_own(patch, is_up ? path.up.regimes : path.down.regimes,
                             way_name(name, direction) + ".");
        }
    });
    return own;
}

Patch patch_of(std::span<const Setting> settings, std::string_view name, Direction direction,
               const Conditions& after)
{
    Patch patch;
    bool sets_bursts = false;
    bool sets_correlation = false;
    bool sets_regimes = false;
    in_turn(settings, name, [&](const Setting& setting) {
        if (setting.direction && *setting.direction != direction) return;
        patch = merged(std::move(patch), setting.settings.patch);
        sets_bursts = sets_bursts || setting.settings.burst_loss;
        sets_correlation = sets_correlation || setting.settings.correlation_time;
        sets_regimes = sets_regimes || changes_regimes(setting.settings);
    });
    if (sets_correlation && !is_nothing(after.jitter)) patch.jitter = after.jitter;
    if (sets_correlation && is_nothing(after.jitter)) patch.delay = after.delay;
    if (sets_bursts) patch.loss = after.loss;
    if (sets_regimes) patch.regimes = after.regimes;
    return patch;
}

} // namespace hapnet::emulator
