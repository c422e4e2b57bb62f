// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/endpoints.hpp"

#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

/// One side: where the emulator listens, and who is there.
struct Side {
    net::Endpoint listen;
    std::optional<net::Endpoint> peer;
};

base::Result<Side> look_up_side(const char* name, const net::HostPort& listen,
                                const std::optional<net::HostPort>& peer)
{
    Side side{net::resolve(listen), std::nullopt};
    if (!peer) {
        if (side.listen.is_loopback()) return side;
        return base::fail(fmt::format("--listen-{0} {1} can be reached from other machines: name "
                                      "the one sender that may use it: --{0} HOST:PORT",
                                      name, side.listen.to_text()));
    }
    side.peer = net::resolve(*peer, side.listen.family());
    if (side.listen.is_loopback() && !side.peer->is_loopback()) {
        return base::fail(
            fmt::format("--{0} {1} cannot be reached from --listen-{0} {2}: listen on {3}, or on "
                        "an address of this machine that the peer there can reach",
                        name, side.peer->to_text(), side.listen.to_text(),
                        side.listen.family() == AF_INET6 ? "[::]" : "0.0.0.0"));
    }
    net::require_route(*side.peer);
    return side;
}

/// A datagram that is sent to the emulator itself would go round for ever.
base::Result<Endpoints> without_loop(Endpoints endpoints)
{
    for (const auto& [name, peer] : {std::pair{"a", endpoints.a}, std::pair{"b", endpoints.b}}) {
        for (const auto& listen : {endpoints.listen_a, endpoints.listen_b}) {
            if (!peer || !peer->reaches(listen)) continue;
            return base::fail(fmt::format("--{} {} is where the emulator itself listens: name the "
                                          "other program's address",
                                          name, peer->to_text()));
        }
    }
    return endpoints;
}

} // namespace

base::Result<Endpoints> look_up(const Options& options)
{
    const auto a = look_up_side("a", options.listen_a, options.a);
    if (!a) return tl::unexpected{a.error()};
    const auto b = look_up_side("b", options.listen_b, options.b);
    if (!b) return tl::unexpected{b.error()};
    if (a->listen == b->listen && a->listen.port() != 0) {
        return base::fail(fmt::format("--listen-a and --listen-b are the same address, {}: give "
                                      "each side its own port",
                                      a->listen.to_text()));
    }
    return without_loop({a->listen, b->listen, a->peer, b->peer});
}

base::Result<ports::Upstream::Places> look_up(const UpstreamOptions& options)
{
    const auto listen = net::resolve(options.listen);
    const auto server = net::resolve(options.upstream);
    if (server.reaches(listen)) {
        return base::fail(
            fmt::format("--upstream {} is where the emulator itself listens: name the "
                        "server's address",
                        server.to_text()));
    }
    ports::Upstream::Places places{listen, server, {}};
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
    for (const auto& pattern : options.allowed) {
        if (auto added = places.allowed.add(pattern, listen.family()); !added) {
            return base::fail("--allow " + added.error().message);
        }
    }
    net::require_route(server);
    return places;
}

} // namespace hapnet::emulator
