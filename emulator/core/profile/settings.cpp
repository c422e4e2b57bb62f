// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/settings.hpp"

#include "emulator/core/profile/faults.hpp"
#include "emulator/core/profile/laws.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

/// "none", the short form of the first parameter, or a table.
template <typename Stage>
Stage read_stage(const Node& node, Reading& reading)
{
    Stage stage = Form<Stage>::defaults();
    const auto* text = std::get_if<std::string>(&node.value);
    if (text != nullptr && *text == "none") return stage;
    if (const auto* entries = std::get_if<Node::Table>(&node.value)) {
        TableReader table{*entries, node.place, reading};
        stage = read_fields<Stage>(table);
        table.finish();
    } else {
        read_field(node, std::get<0>(Form<Stage>::fields), stage, reading);
    }
    const auto fault = fault_of(stage);
    if (fault) reading.complain(node.place, *fault);
    return stage;
}

/// The short form when it says all.
template <typename Stage>
std::string stage_text(const Stage& stage)
{
    constexpr auto first = std::get<0>(Form<Stage>::fields);
    Stage as_short = Form<Stage>::defaults();
    as_short.*first.member = stage.*first.member;
    return stage == as_short ? field_text(first, stage) : table_text(field_texts(stage));
}

template <typename T, typename ToText>
std::optional<std::string> text_if(const std::optional<T>& value, ToText to_toml)
{
    return value ? std::optional{to_toml(*value)} : std::nullopt;
}

std::vector<LossLaw> read_burst_loss(const Node& node, Reading& reading)
{
    const auto* text = std::get_if<std::string>(&node.value);
    if (text != nullptr && *text == "none") return {};
    const Burst burst = read_burst(node, reading);
    if (burst.lost == 0 && burst.of > 0) return {};
    const auto fault = fault_of(LossLaw{burst});
    if (fault) reading.complain(node.place, *fault);
    return {burst};
}

} // namespace

void read_setting(std::string_view key, const Node& node, DirectionSettings& settings,
                  Reading& reading)
{
    Patch& patch = settings.patch;
    if (key == "mtu") {
        patch.mtu = read_stage<Mtu>(node, reading);
    } else if (key == "rate") {
        patch.rate = read_stage<Rate>(node, reading);
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
        if (order) reading.complain(node.place, "order is a key of jitter, not of delay");
    } else if (key == "jitter") {
        std::optional<Order> order;
        patch.jitter = read_variation(node, Role::jitter, order, reading);
        if (order && patch.order && *order != *patch.order) {
            reading.complain(node.place, "jitter says another order than the key order");
        }
        if (order) patch.order = order;
    } else if (key == "order") {
        const Order order = read_order(node, reading);
        if (patch.order && *patch.order != order) {
            reading.complain(node.place, "jitter says another order than the key order");
        }
        patch.order = order;
    } else {
        base::ensure(key == "reorder");
        patch.reorder = read_stage<Reordering>(node, reading);
    }
}

DirectionSettings read_direction(const Node& node, Reading& reading)
{
    DirectionSettings settings;
    const auto* entries = std::get_if<Node::Table>(&node.value);
    if (entries == nullptr) {
        reading.complain(node.place, "a table of settings belongs here, such as [both]");
        return settings;
    }
    TableReader table{*entries, node.place, reading};
    for (const std::string_view key : setting_keys) {
        if (const Node* value = table.find(key)) read_setting(key, *value, settings, reading);
    }
    table.finish();
    return settings;
}

Patch merged(Patch a, const Patch& b)
{
    const auto set = [](auto& target, const auto& value) {
        if (value) target = value;
    };
    set(a.mtu, b.mtu);
    set(a.rate, b.rate);
    set(a.loss, b.loss);
    set(a.corrupt, b.corrupt);
    set(a.duplicate, b.duplicate);
    set(a.delay, b.delay);
    set(a.jitter, b.jitter);
    set(a.order, b.order);
    set(a.reorder, b.reorder);
    return a;
}

std::array<std::optional<std::string>, setting_keys.size()> setting_texts(const Patch& patch)
{
    const auto stage = [](const auto& value) { return stage_text(value); };
    return {
        text_if(patch.mtu, stage),
        text_if(patch.rate, stage),
        text_if(patch.loss, losses_text),
        std::nullopt,
        text_if(patch.corrupt, stage),
        text_if(patch.duplicate, stage),
        text_if(patch.delay, [](const auto& value) { return variation_text(value, Role::delay); }),
        text_if(patch.jitter,
                [](const auto& value) { return variation_text(value, Role::jitter); }),
        text_if(patch.order, [](Order order) { return base::quoted(to_text(order)); }),
        text_if(patch.reorder,
                [](const Reordering& value) {
                    return value == Reordering{} ? base::quoted("none") : stage_text(value);
                }),
    };
}

Patch patch_of(const Conditions& conditions)
{
    const Conditions defaults;
    Patch patch;
    const auto set = [&](auto& target, auto member) {
        if (conditions.*member != defaults.*member) target = conditions.*member;
    };
    set(patch.mtu, &Conditions::mtu);
    set(patch.rate, &Conditions::rate);
    set(patch.loss, &Conditions::loss);
    set(patch.corrupt, &Conditions::corrupt);
    set(patch.duplicate, &Conditions::duplicate);
    set(patch.delay, &Conditions::delay);
    set(patch.jitter, &Conditions::jitter);
    set(patch.order, &Conditions::order);
    set(patch.reorder, &Conditions::reorder);
    return patch;
}

} // namespace hapnet::emulator
