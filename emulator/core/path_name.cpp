// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/path_name.hpp"

#include "emulator/core/flow/flow.hpp"
#include "emulator/core/profile/settings.hpp"
#include "proto/base/reading.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

constexpr std::string_view client_prefix = "client.";
constexpr std::string_view flow_prefix = "flow.";

/// The numbers of two peers, "2-1".
struct Peers {
    unsigned int from = 0;
    unsigned int to = 0;
};

std::optional<Peers> parse_peers(std::string_view text)
{
    constexpr unsigned int peer_max = 999;
    const auto dash = text.find('-');
    if (dash == std::string_view::npos) return std::nullopt;
    Peers peers;
    const auto read = [](std::string_view digits, unsigned int& target) {
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), target);
        return error == std::errc{} && end == digits.data() + digits.size() && target >= 1 &&
               target <= peer_max && digits.front() != '0';
    };
    const auto from = text.substr(0, dash);
    const auto to = text.substr(dash + 1);
    if (from.empty() || to.empty() || !read(from, peers.from) || !read(to, peers.to)) {
        return std::nullopt;
    }
    if (peers.from == peers.to) return std::nullopt;
    return peers;
}

/// True for letters, digits, '-' and '_', with a letter first, if it is no word with which a key
/// may begin.
bool is_word(std::string_view text)
{
    constexpr std::size_t longest = 32;
    constexpr std::array<std::string_view, 10> taken{"up",   "down", "both",   "all",    "link",
                                                     "time", "ramp", "client", "matrix", "flow"};
    const auto is_taken = [&](const auto& words) {
        return std::ranges::find(words, text) != words.end();
    };
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto fits = [&](char c) {
        return is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '_';
    };
    return !text.empty() && text.size() <= longest && is_letter(text.front()) &&
           std::ranges::all_of(text, fits) && !is_taken(taken) && !is_taken(setting_keys);
}

std::optional<Way> way_of_all(std::string_view text)
{
    if (text.empty() || text == "all" || text == "both") return Way{};
    if (text == "up") return Way{"", Direction::up};
    if (text == "down") return Way{"", Direction::down};
    return std::nullopt;
}

} // namespace

PathParts parts_of(std::string_view name)
{
    if (name.starts_with(flow_prefix)) return {"", name.substr(flow_prefix.size())};
    const auto at = name.find(".flow.");
    if (at == std::string_view::npos) return {name, ""};
    return {name.substr(0, at), name.substr(at + 1 + flow_prefix.size())};
}

std::string flow_path(std::string_view path, std::string_view flow)
{
    if (flow.empty()) return std::string{path};
    return fmt::format("{}{}{}{}", path, path.empty() ? "" : ".", flow_prefix, flow);
}

std::string_view common_name(std::string_view name)
{
    const auto flow = parts_of(name).flow;
    return flow.empty() ? "" : name.substr(name.size() - flow.size() - flow_prefix.size());
}

bool is_pair(std::string_view path) { return parse_peers(path).has_value(); }

std::string way_name(std::string_view path, Direction direction)
{
    if (path.empty()) return std::string{to_text(direction)};
    const auto [of, flow] = parts_of(path);
    const auto peers = parse_peers(of);
    if (!peers) return fmt::format("{}.{}", path, to_text(direction));
    return direction == Direction::up
               ? std::string{path}
               : flow_path(fmt::format("{}-{}", peers->to, peers->from), flow);
}

std::string way_in_words(std::string_view path, Direction direction)
{
    const bool is_up = direction == Direction::up;
    auto name = way_name(path, direction);
    path = parts_of(path).path;
    if (path.empty()) return name + (is_up ? ": from A to B" : ": from B to A");
    if (const auto peers = parse_peers(path)) {
        return fmt::format("{}: from {} to {}", name, is_up ? peers->from : peers->to,
                           is_up ? peers->to : peers->from);
    }
    if (!path.starts_with(client_prefix)) return name;
    return name + (is_up ? ": to the server" : ": from the server");
}

std::string stream_name(std::string_view path, Direction direction)
{
    const auto [of, flow] = parts_of(path);
    const bool is_of_peers = is_pair(of);
    if (flow.empty() && (of.empty() || is_of_peers)) return way_name(path, direction);
    std::string name = is_of_peers ? way_name(of, direction) : std::string{of};
    if (of.starts_with(client_prefix)) {
        name = fmt::format("client/{}", of.substr(client_prefix.size()));
    }
    if (!flow.empty()) name += fmt::format("{}flow/{}", name.empty() ? "" : "/", flow);
    return is_of_peers ? name : fmt::format("{}/{}", name, to_text(direction));
}

std::string stream_name_of_both(std::string_view path)
{
    const auto up = stream_name(path, Direction::up);
    const bool is_of_peers = is_pair(parts_of(path).path);
    if (is_of_peers) return up + "/both";
    return up.substr(0, up.size() - to_text(Direction::up).size()) + "both";
}

base::Result<std::string> parse_link_name(std::string_view text)
{
    if (const auto peers = parse_peers(text)) {
        if (peers->from < peers->to) return std::string{text};
        return base::fail(
            fmt::format("'{}': name the lower number first: {}-{}", text, peers->to, peers->from));
    }
    if (is_word(text)) return std::string{text};
    return base::fail(fmt::format("'{}' is not the name of a link: write two numbers of peers, "
                                  "such as 1-2, or a word of letters and digits, such as wan",
                                  text));
}

namespace {

/// Parses "flow.voice.up", or a flow on one path: "client.3.flow.voice", "2-1.flow.voice". `flow`
/// may end with a direction, unless `path` determines it.
std::optional<Way> way_of_flow(std::string_view path, std::string_view flow)
{
    const auto of = path.empty() ? Way{} : parse_way(path).value_or(Way{});
    if (of.path.empty() != path.empty()) return std::nullopt;
    Way way{{}, of.direction};
    const auto dot = flow.find('.');
    if (dot != std::string_view::npos) {
        const auto last = way_of_all(flow.substr(dot + 1));
        if (way.direction || !last || flow.substr(dot + 1) == "all") return std::nullopt;
        way.direction = last->direction;
        flow = flow.substr(0, dot);
    }
    if (way.direction && !of.path.empty() && of.direction && !is_pair(of.path)) return std::nullopt;
    if (!validate_flow_name(flow)) return std::nullopt;
    way.path = flow_path(of.path, flow);
    return way;
}

} // namespace

std::optional<Way> parse_way(std::string_view text)
{
    if (auto all = way_of_all(text)) return all;
    if (const auto [path, flow] = parts_of(text); !flow.empty()) return way_of_flow(path, flow);
    if (const auto peers = parse_peers(text)) {
        if (peers->from < peers->to) return Way{std::string{text}, Direction::up};
        return Way{fmt::format("{}-{}", peers->to, peers->from), Direction::down};
    }
    std::optional<Direction> direction;
    if (const auto dot = text.rfind('.'); dot != std::string_view::npos) {
        const auto last = text.substr(dot + 1);
        if (last == "up") direction = Direction::up;
        if (last == "down") direction = Direction::down;
        if (direction || last == "both") text = text.substr(0, dot);
    }
    const bool is_client = text.starts_with(client_prefix) && text.size() > client_prefix.size();
    if (!is_client && !is_word(text)) return std::nullopt;
    return Way{std::string{text}, direction};
}

bool is_command(std::string_view text)
{
    return text.size() == 1 && text.front() >= 'a' && text.front() <= 'h';
}

bool is_of_commands(std::string_view path)
{
    return path.size() == 3 && path[1] == '-' && is_command(path.substr(0, 1)) &&
           is_command(path.substr(2));
}

Way way_between(std::string_view from, std::string_view to)
{
    const auto name = fmt::format("{}-{}", from, to);
    if (!is_command(from)) return parse_way(name).value();
    if (from < to) return {name, Direction::up};
    return {fmt::format("{}-{}", to, from), Direction::down};
}

std::string client_path(std::string_view number_or_address)
{
    return fmt::format("{}{}", client_prefix, number_or_address);
}

bool PathNames::contains(std::string_view path) const
{
    const auto [of, flow] = parts_of(path);
    if (!flow.empty() && std::ranges::find(flows, flow) == flows.end()) return false;
    path = of;
    if (any || path.empty()) return true;
    if (path.starts_with(client_prefix)) return clients;
    return std::ranges::find(links, path) != links.end();
}

std::string PathNames::refusal(std::string_view path) const
{
    const auto [of, flow] = parts_of(path);
    if (!flow.empty() && std::ranges::find(flows, flow) == flows.end()) {
        const std::vector<std::string_view> known{flows.begin(), flows.end()};
        return fmt::format("there is no flow {}: {}", base::in_quotes(flow),
                           known.empty() ? "a profile describes flows by [[flow]]"
                                         : base::suggestion(flow, known));
    }
    path = of;
    if (path.starts_with(client_prefix)) {
        return fmt::format("there is no {}: clients are those of --upstream", path);
    }
    if (links.empty() && !without_links.empty()) {
        return fmt::format("there is no link {}: {}", path, without_links);
    }
    if (links.empty()) {
        return fmt::format("there is no link {0}: start the emulator with --link {0}=LISTEN_A,"
                           "LISTEN_B",
                           path);
    }
    return fmt::format("there is no link {}: use one of {}", path, fmt::join(links, ", "));
}

} // namespace hapnet::emulator
