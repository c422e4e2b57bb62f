// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/path_name.hpp"

#include "emulator/core/profile/settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

constexpr std::string_view client_prefix = "client.";

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

/// Letters, digits, '-' and '_', with a letter first, and no word that a key may begin with.
bool is_word(std::string_view text)
{
    constexpr std::size_t longest = 32;
    constexpr std::array<std::string_view, 9> taken{"up",   "down", "both",   "all",   "link",
                                                    "time", "ramp", "client", "matrix"};
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

bool is_pair(std::string_view path) { return parse_peers(path).has_value(); }

std::string way_name(std::string_view path, Direction direction)
{
    if (path.empty()) return std::string{to_text(direction)};
    const auto peers = parse_peers(path);
    if (!peers) return fmt::format("{}.{}", path, to_text(direction));
    return direction == Direction::up ? std::string{path}
                                      : fmt::format("{}-{}", peers->to, peers->from);
}

std::string way_in_words(std::string_view path, Direction direction)
{
    const bool is_up = direction == Direction::up;
    auto name = way_name(path, direction);
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
    if (path.empty() || is_pair(path)) return way_name(path, direction);
    if (path.starts_with(client_prefix)) {
        return fmt::format("client/{}/{}", path.substr(client_prefix.size()), to_text(direction));
    }
    return fmt::format("{}/{}", path, to_text(direction));
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

std::optional<Way> parse_way(std::string_view text)
{
    if (auto all = way_of_all(text)) return all;
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

std::string client_path(std::string_view number_or_address)
{
    return fmt::format("{}{}", client_prefix, number_or_address);
}

bool PathNames::contains(std::string_view path) const
{
    if (any || path.empty()) return true;
    if (path.starts_with(client_prefix)) return clients;
    return std::ranges::find(links, path) != links.end();
}

std::string PathNames::refusal(std::string_view path) const
{
    if (path.starts_with(client_prefix)) {
        return fmt::format("there is no {}: clients are those of --upstream", path);
    }
    if (links.empty()) {
        return fmt::format("there is no link {0}: start the emulator with --link {0}=LISTEN_1,"
                           "LISTEN_2",
                           path);
    }
    return fmt::format("there is no link {}: use one of {}", path, fmt::join(links, ", "));
}

} // namespace hapnet::emulator
