// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/endpoints.hpp"

#include "proto/net/program.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

/// One side as it was typed, and the names of its options.
struct TypedSide {
    const net::HostPort& listen;
    const std::vector<net::AddressPattern>& ends;
    std::string listen_name; // "--listen-a"
    std::string end_name;    // "--a"
};

/// A side whose names are resolved.
struct Side {
    net::Endpoint listen;
    std::optional<net::Endpoint> peer;
    std::optional<net::AddressSet> allowed;
};

/// Resolves where datagrams are sent, and reports a name with several addresses: the program may
/// listen on another one than the first.
net::Endpoint look_up_destination(const net::HostPort& where, const std::string& option,
                                  int family = AF_UNSPEC)
{
    const auto all = net::resolve_all(where, family);
    if (all.size() > 1) {
        std::vector<std::string> texts;
        for (const net::Endpoint& one : all) texts.push_back(one.to_text());
        net::say("hapnet-emulator",
                 fmt::format("{} {}:{} has {} addresses, {}: datagrams go to the first; if the "
                             "program there listens on another one, name that",
                             option, where.host, where.port, all.size(),
                             fmt::join(texts, " and ")));
    }
    return all.front();
}

base::Result<Side> side_of_one_peer(const TypedSide& typed, const net::Endpoint& listen)
{
    const net::AddressPattern& end = typed.ends.front();
    const auto peer = look_up_destination({end.host, *end.port}, typed.end_name, listen.family());
    if (listen.is_loopback() && !peer.is_loopback()) {
        return base::fail(fmt::format(
            "{0} {2} cannot be reached from {1} {3}: listen on {4}, or on an address of this "
            "machine that the peer there can reach",
            typed.end_name, typed.listen_name, peer.to_text(), listen.to_text(),
            listen.family() == AF_INET6 ? "[::]" : "0.0.0.0"));
    }
    net::require_route(peer);
    return Side{listen, peer, std::nullopt};
}

base::Result<net::AddressSet> set_of(const std::vector<net::AddressPattern>& patterns,
                                     const net::Endpoint& listen, const std::string& option)
{
    net::AddressSet set;
    for (const auto& pattern : patterns) {
        if (auto added = set.add(pattern, listen.family()); !added) {
            return base::fail(fmt::format("{} {}", option, added.error().message));
        }
    }
    return set;
}

base::Result<Side> look_up_side(const TypedSide& typed)
{
    const auto listen = net::resolve(typed.listen);
    if (typed.ends.empty()) {
        if (listen.is_loopback()) return Side{listen, std::nullopt, std::nullopt};
        return base::fail(fmt::format("{} {} can be reached from other machines: name "
                                      "the one sender that may use it: {} HOST:PORT",
                                      typed.listen_name, listen.to_text(), typed.end_name));
    }
    if (typed.ends.size() == 1 && typed.ends.front().port) return side_of_one_peer(typed, listen);
    auto allowed = set_of(typed.ends, listen, typed.end_name);
    if (!allowed) return tl::unexpected{allowed.error()};
    if (listen.is_loopback() && !allowed->is_loopback()) {
        return base::fail(fmt::format("{} names hosts that cannot be reached from {} {}: listen "
                                      "on {}",
                                      typed.end_name, typed.listen_name, listen.to_text(),
                                      listen.family() == AF_INET6 ? "[::]" : "0.0.0.0"));
    }
    return Side{listen, std::nullopt, *std::move(allowed)};
}

base::Result<Endpoints> look_up_sides(const TypedSide& typed_a, const TypedSide& typed_b)
{
    auto a = look_up_side(typed_a);
    if (!a) return tl::unexpected{a.error()};
    auto b = look_up_side(typed_b);
    if (!b) return tl::unexpected{b.error()};
    if (a->listen == b->listen && a->listen.port() != 0) {
        return base::fail(fmt::format("{} and {} are the same address, {}: give each side its own "
                                      "port",
                                      typed_a.listen_name, typed_b.listen_name,
                                      a->listen.to_text()));
    }
    return Endpoints{
        a->listen, b->listen, a->peer, b->peer, std::move(a->allowed), std::move(b->allowed)};
}

/// Refuses links that send to the emulator itself: such datagrams would circulate for ever.
base::Result<std::vector<NamedEndpoints>> without_loop(std::vector<NamedEndpoints> links)
{
    const auto is_own = [&](const net::Endpoint& peer) {
        return std::ranges::any_of(links, [&](const NamedEndpoints& one) {
            return peer.reaches(one.endpoints.listen_a) || peer.reaches(one.endpoints.listen_b);
        });
    };
    for (const auto& [link, endpoints] : links) {
        for (const auto& [name, peer] :
             {std::pair{"a", endpoints.a}, std::pair{"b", endpoints.b}}) {
            if (!peer || !is_own(*peer)) continue;
            const auto option =
                link.empty() ? fmt::format("--{}", name) : fmt::format("--link {}:", link);
            return base::fail(fmt::format("{} {} is where the emulator itself listens: name the "
                                          "other program's address",
                                          option, peer->to_text()));
        }
    }
    return links;
}

} // namespace

base::Result<std::vector<NamedEndpoints>> look_up(const Options& options)
{
    auto endpoints = look_up_sides({options.listen_a, options.a, "--listen-a", "--a"},
                                   {options.listen_b, options.b, "--listen-b", "--b"});
    if (!endpoints) return tl::unexpected{endpoints.error()};
    return without_loop({{"", *std::move(endpoints)}});
}

base::Result<std::vector<NamedEndpoints>> look_up(const LinkOptions& options)
{
    std::vector<NamedEndpoints> links;
    for (const TypedLink& link : options.links) {
        const auto part = [&](const char* what) {
            return fmt::format("--link {}: {}", link.name, what);
        };
        auto endpoints =
            look_up_sides({link.listen_1, link.end_1, part("LISTEN_A"), part("END_A")},
                          {link.listen_2, link.end_2, part("LISTEN_B"), part("END_B")});
        if (!endpoints) return tl::unexpected{endpoints.error()};
        links.push_back({link.name, *std::move(endpoints)});
    }
    return without_loop(std::move(links));
}

base::Result<ServerAndClients> look_up(const UpstreamOptions& options)
{
    const auto listen = net::resolve(options.listen);
    const auto server = look_up_destination(options.upstream, "--upstream");
    if (server.reaches(listen)) {
        return base::fail(
            fmt::format("--upstream {} is where the emulator itself listens: name the "
                        "server's address",
                        server.to_text()));
    }
    ServerAndClients places{listen, server, {}};
    if (options.allowed.empty()) {
        if (!listen.is_loopback()) {
            return base::fail(fmt::format("--listen {} can be reached from other machines: say who "
                                          "may use it with --allow, such as --allow 10.0.0.0/8",
                                          listen.to_text()));
        }
        for (const auto& loopback : {net::AddressPattern{"127.0.0.0", std::nullopt, 8},
                                     net::AddressPattern{"::1", std::nullopt, std::nullopt}}) {
            if (auto added = places.allowed.add(loopback); !added) {
                return tl::unexpected{added.error()};
            }
        }
    }
    if (!options.allowed.empty()) {
        auto allowed = set_of(options.allowed, listen, "--allow");
        if (!allowed) return tl::unexpected{allowed.error()};
        places.allowed = *std::move(allowed);
    }
    net::require_route(server);
    return places;
}

} // namespace hapnet::emulator
