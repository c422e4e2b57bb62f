// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/typed_link.hpp"

#include "emulator/core/path_name.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

base::Result<TypedLink> parse_link(std::string_view text)
{
    const auto refuse = [&](const std::string& why) {
        return base::fail(fmt::format("'{}': {}", text, why));
    };
    const auto equals = text.find('=');
    if (equals == std::string_view::npos) {
        return refuse("write NAME=LISTEN_A,LISTEN_B, such as 1-2=:7001,:7002");
    }
    auto name = parse_link_name(text.substr(0, equals));
    if (!name) return tl::unexpected{name.error()};
    std::vector<std::string> parts{""};
    for (const char c : text.substr(equals + 1)) {
        if (c == ',') {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    if (parts.size() != 2 && parts.size() != 4) {
        return refuse("write two addresses to listen on after the =, or four addresses: "
                      "LISTEN_A,LISTEN_B,END_A,END_B");
    }
    TypedLink link{*std::move(name), {}, {}, {}, {}};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (i < 2) {
            const auto listen = net::parse_listen_address(parts[i]);
            if (!listen) return refuse(listen.error().message);
            (i == 0 ? link.listen_1 : link.listen_2) = *listen;
        } else if (!parts[i].empty()) { // an empty part means the first sender
            const auto end = net::parse_address_pattern(parts[i]);
            if (!end) return refuse(end.error().message);
            (i == 2 ? link.end_1 : link.end_2).push_back(*end);
        }
    }
    return link;
}

base::Result<void> require_different(std::span<const TypedLink> links)
{
    if (links.size() > links_max) {
        return base::fail(fmt::format("--link: at most {}, given {}", links_max, links.size()));
    }
    std::vector<std::string> names;
    std::vector<std::string> places;
    for (const TypedLink& link : links) {
        if (std::ranges::find(names, link.name) != names.end()) {
            return base::fail(fmt::format("--link {} is given twice", link.name));
        }
        names.push_back(link.name);
        for (const net::HostPort& listen : {link.listen_1, link.listen_2}) {
            const auto place = fmt::format("{}:{}", listen.host, listen.port);
            if (listen.port != 0 && std::ranges::find(places, place) != places.end()) {
                return base::fail(fmt::format("--link {}: {} is the address of another side: give "
                                              "each its own port",
                                              link.name, place));
            }
            places.push_back(place);
        }
    }
    return {};
}

} // namespace hapnet::emulator
