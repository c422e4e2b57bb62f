// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/paths_options.hpp"

#include "emulator/core/flow/flow.hpp"
#include "emulator/core/path_name.hpp"
#include "proto/cli/parsers.hpp"
#include "proto/cli/synonyms.hpp"

#include <array>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>

namespace hapnet::emulator {

namespace {

constexpr const char* clients_group = "Any client of a server, instead of A and B";

constexpr const char* links_group = "Many links, instead of A and B";

base::Result<net::HostPort> parse_host(const std::string& text)
{
    auto host = net::parse_host_port(text);
    if (host && host->port == 0) {
        return base::fail(fmt::format("'{}': nothing can be sent to port 0", text));
    }
    return host;
}

base::Result<bool> parse_named_by_address(const std::string& text)
{
    return cli::meant_value("--name-by", text)
        .and_then(cli::one_of({"number", "address"}))
        .map([](const std::string& by) { return by == "address"; });
}

/// Refuses options that have no meaning together with `mode`, an option that replaces them.
base::Result<void> refuse_beside(const char* mode, std::span<const char* const> options,
                                 const cli::Command& program)
{
    for (const char* option : options) {
        if (!program.is_given(option)) continue;
        return base::fail(fmt::format("{} and {} exclude each other", option, mode));
    }
    return {};
}

constexpr std::array ends_of_a_pair{"--listen-a", "--listen-b", "--a", "--b"};

} // namespace

cli::Take allow_into(std::vector<net::AddressPattern>& into)
{
    return [&into](const std::string& text) -> base::Result<void> {
        auto pattern = net::parse_address_pattern(text);
        if (!pattern) return tl::unexpected{pattern.error()};
        into.push_back(*std::move(pattern));
        return {};
    };
}

void add_upstream_options(cli::Command& program, UpstreamOptions& options)
{
    constexpr std::uint64_t clients_most = 1024;
    program
        .option("--upstream", "HOST:PORT",
                "The server. Each address that sends to --listen gets a path of its own to it: up "
                "is to the server",
                cli::into(options.upstream, parse_host))
        .under(clients_group);
    program
        .option("--listen", "ADDRESS", "Where its clients send to",
                cli::into(options.listen, net::parse_listen_address))
        .under(clients_group);
    program
        .option(
            "--allow", "HOST|NET/BITS",
            "Who may be a client, such as 10.0.0.0/8; may be repeated. Required unless --listen "
            "is on loopback",
            allow_into(options.allowed))
        .repeated()
        .under(clients_group);
    program
        .option("--clients", "NUMBER", "How many at a time at most (default 64)",
                cli::into(options.clients_max, base::Count{1, clients_most}))
        .under(clients_group);
    program
        .option("--name-by", "number|address",
                "How a client's path is called, which says what is drawn for it: client.3 by the "
                "order of first datagrams (default), or client.10.0.0.1:5000 where that order is "
                "not the same in each run",
                cli::into(options.named_by_address, parse_named_by_address))
        .under(clients_group);
    program
        .option("--idle", "TIME", "Forget a client that has been silent for so long (default 1min)",
                cli::into(options.idle, base::Time{}))
        .under(clients_group);
}

void add_link_options(cli::Command& program, LinkOptions& options)
{
    program
        .option("--link", "NAME=LISTEN_A,LISTEN_B[,END_A,END_B]",
                "A pair of its own; may be repeated, up to 28 times. NAME is two numbers of "
                "peers, 1-2, whose ways have the keys 1-2.delay and 2-1.delay, or a word, wan, "
                "with wan.up.delay and wan.down.delay. END is what --a takes",
                [&options](const std::string& text) -> base::Result<void> {
                    auto link = parse_link(text);
                    if (!link) return tl::unexpected{link.error()};
                    options.links.push_back(*std::move(link));
                    return {};
                })
        .repeated()
        .under(links_group);
}

void add_threads(cli::Command& program, std::size_t& threads)
{
    constexpr std::uint64_t threads_most = 16;
    program
        .option("--threads", "NUMBER",
                "How many threads relay, with --link or --upstream (default 1): each link or "
                "client is on one of them, and --in-flight is divided among them. What becomes of "
                "a datagram does not depend on it",
                cli::into(threads, base::Count{1, threads_most}))
        .under(links_group);
}

base::Result<void> require_upstream(const cli::Command& program)
{
    for (const char* option : ends_of_a_pair) {
        if (!program.is_given(option)) continue;
        return base::fail(fmt::format("{} and --upstream exclude each other: clients send to "
                                      "--listen",
                                      option));
    }
    if (program.is_given("--listen")) return {};
    return base::fail("--listen is required: --listen 127.0.0.1:7001");
}

base::Result<void> require_links(const LinkOptions& options, const cli::Command& program)
{
    constexpr std::array of_clients{"--upstream", "--listen", "--allow",
                                    "--clients",  "--idle",   "--name-by"};
    auto fine = refuse_beside("--link", ends_of_a_pair, program);
    if (fine) fine = refuse_beside("--link", of_clients, program);
    if (!fine) return fine;
    return require_different(options.links);
}

cli::Take into_path(std::string& path)
{
    return [&path](const std::string& text) -> base::Result<void> {
        const auto way = parse_way(text);
        const auto name = way && !way->path.empty() ? way->path : parse_link_name(text);
        if (!name) return tl::unexpected{name.error()};
        path = flow_path(*name, parts_of(path).flow);
        return {};
    };
}

cli::Take into_flow(std::string& path)
{
    return [&path](const std::string& text) -> base::Result<void> {
        path = flow_path(parts_of(path).path, text == rest_of_flows ? "" : text);
        return {};
    };
}

} // namespace hapnet::emulator
