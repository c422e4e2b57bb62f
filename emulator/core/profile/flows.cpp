// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/flows.hpp"

#include "emulator/core/flow/packet_facts.hpp"
#include "emulator/core/profile/settings.hpp"
#include "proto/base/fields.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

/// Reads the tables of settings of one flow.
std::vector<Setting> read_flow_settings(TableReader& table, const std::string& path)
{
    constexpr std::array<std::pair<std::string_view, std::optional<Direction>>, 3> ways{
        {{"both", std::nullopt}, {"up", Direction::up}, {"down", Direction::down}}};
    std::vector<Setting> settings;
    for (const auto& [key, direction] : ways) {
        const Node* node = table.find(key);
        if (node == nullptr) continue;
        settings.push_back({direction, read_direction(*node, table.reading()), path});
    }
    return settings;
}

/// Returns true if the patch, or a regime in it, sets a rate or a queue.
bool has_rate(const Patch& patch)
{
    const auto sets_rate = [](const Regime& regime) { return regime.own.rate.has_value(); };
    return patch.rate || patch.queue ||
           (patch.regimes && std::ranges::any_of(patch.regimes->all, sets_rate));
}

/// Returns the contradiction within a flow; "": there is none.
std::string contradiction_of(const Flow& flow, const PathPatch& own)
{
    const bool has_settings = own.up != Patch{} || own.down != Patch{};
    if (flow.passes && (has_settings || flow.shares_rate)) {
        return "pass = true leaves its packets untouched: write that alone, or conditions";
    }
    if (flow.shares_rate && (has_rate(own.up) || has_rate(own.down))) {
        return "rate = \"shared\" is the rate and the queue of the profile: write that, or a rate "
               "of its own";
    }
    if (const auto valid = validate(flow.match); !valid) return valid.error().message;
    return "";
}

void read_flow(const Node& node, Profile& profile, Reading& reading)
{
    const auto* entries = std::get_if<Node::Table>(&node.value);
    if (entries == nullptr) {
        return reading.complain(node.place, "expected a table with a name: [[flow]]");
    }
    TableReader table{*entries, node.place, reading};
    Flow flow;
    base::read_fields(table, flow);
    const auto path = flow_path("", flow.name);
    const auto settings = read_flow_settings(table, path);
    table.finish();
    if (!reading.is_good()) return;
    if (std::ranges::find(profile.flows, flow.name, &Flow::name) != profile.flows.end()) {
        return reading.complain(node.place, fmt::format("there is a flow '{}' already: give each "
                                                        "its own name",
                                                        flow.name));
    }
    const auto after = with_settings({}, settings, path);
    if (!after) return reading.complain(node.place, after.error().message);
    PathPatch own{path, patch_of(settings, path, Direction::up, after->up),
                  patch_of(settings, path, Direction::down, after->down)};
    if (const auto what = contradiction_of(flow, own); !what.empty()) {
        return reading.complain(node.place, fmt::format("flow '{}': {}", flow.name, what));
    }
    profile.flows.push_back(std::move(flow));
    if (own.up != Patch{} || own.down != Patch{}) profile.paths.push_back(std::move(own));
}

} // namespace

void read_flows(TableReader& table, Profile& profile)
{
    const Node* node = table.find("flow");
    if (node == nullptr) return;
    Reading& reading = table.reading();
    const auto* list = std::get_if<Node::List>(&node->value);
    if (list == nullptr) {
        return reading.complain(node->place, "write flows as [[flow]], each with a name");
    }
    if (list->size() > flows_max) {
        return reading.complain(node->place,
                                fmt::format("a profile can have at most {} flows", flows_max));
    }
    for (const Node& element : *list) read_flow(element, profile, reading);
    std::ranges::sort(profile.paths, {}, &PathPatch::path);
}

std::string flow_lines(const Flow& flow)
{
    std::string lines;
    for (const std::string& line : base::field_texts(flow, base::Print::needed)) {
        lines += line + '\n';
    }
    return lines;
}

PathNames with_flows(PathNames names, std::span<const Flow> flows)
{
    for (const Flow& flow : flows) {
        names.flows.push_back(flow.name);
        if (flow.shares_rate) names.without_rate.push_back(flow.name);
        if (flow.passes) names.untouched.push_back(flow.name);
    }
    return names;
}

base::Result<void> validate_patch(const Patch& patch, std::string_view path, const PathNames& names)
{
    const auto flow = parts_of(path).flow;
    const auto is_in = [&](const std::vector<std::string>& flows) {
        return std::ranges::find(flows, flow) != flows.end();
    };
    if (is_in(names.untouched)) {
        return base::fail(fmt::format("the flow {} passes untouched: leave out pass = true to give "
                                      "it conditions",
                                      flow));
    }
    if (!is_in(names.without_rate) || !has_rate(patch)) return {};
    return base::fail(fmt::format("the flow {} shares the rate and the queue of the profile: set "
                                  "those, or leave out rate = \"shared\"",
                                  flow));
}

base::Result<void> validate_for_datagrams(std::span<const Flow> flows)
{
    for (const Flow& flow : flows) {
        const bool is_arp = flow.match.protocol == PacketFacts::arp;
        if (!is_arp && !flow.match.dscp) continue;
        return base::fail(fmt::format("flow '{}': {} is not known here, where only UDP datagrams "
                                      "pass: match addresses, ports and sizes, or use between, "
                                      "exec or bridge",
                                      flow.name, is_arp ? "protocol = \"arp\"" : "dscp"));
    }
    return {};
}

base::Result<void> validate_for_frames(std::span<const Flow> flows, bool all_frames)
{
    for (const Flow& flow : flows) {
        if (all_frames || flow.match.protocol != PacketFacts::arp) continue;
        return base::fail(fmt::format("flow '{}': protocol = \"arp\" needs --all-frames, without "
                                      "which ARP passes undisturbed",
                                      flow.name));
    }
    return {};
}

base::Result<void> ensure_same_flows(const Profile& profile, std::span<const Flow> flows)
{
    if (std::ranges::equal(profile.flows, flows)) return {};
    const auto names = [](std::span<const Flow> all) {
        std::vector<std::string_view> list;
        for (const Flow& flow : all) list.push_back(flow.name);
        return all.empty() ? std::string{"none"} : fmt::format("{}", fmt::join(list, ", "));
    };
    return base::fail(fmt::format("the flows of a run cannot change: the profile has {}, and the "
                                  "run has {}. Write [[flow]] as at the start, or start again",
                                  names(profile.flows), names(flows)));
}

} // namespace hapnet::emulator
