// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/key_options.hpp"

#include "proto/base/text.hpp"
#include "proto/secure/keys/files.hpp"
#include "proto/secure/keys/process.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::peer {

namespace {

base::Result<void> take_key(const std::string& path, KeyChoice& choice)
{
    secure::keys::hide_process();
    secure::prepare();
    auto file = secure::keys::read_key_file(path);
    if (!file) return tl::unexpected{file.error()};
    if (file->others.empty()) {
        return base::fail(fmt::format("{} knows no other peer: add it with 'hapnet-peer key add "
                                      "{} --id ID --public KEY'",
                                      path, path));
    }
    choice.file = std::make_shared<const secure::KeyFile>(*std::move(file));
    choice.path = path;
    return {};
}

base::Result<void> check_named(const KeyChoice& choice, const std::vector<NamedPeer>& named)
{
    for (const NamedPeer& peer : named) {
        if (std::ranges::count(named, peer.id, &NamedPeer::id) > 1)
            return base::fail(fmt::format("--peer {}: this peer is named twice", peer.id));
        if (!choice.is_given() || choice.file->find(peer.id) != nullptr) continue;
        return base::fail(
            fmt::format("--peer: {} knows no peer {}: 'hapnet-peer key show {}' lists them",
                        choice.path, peer.id, choice.path));
    }
    return {};
}

/// Returns the only other peer, whose address is that of --remote.
base::Result<std::vector<NamedPeer>> other_at(const net::HostPort& place, const KeyChoice& choice)
{
    if (!choice.is_given()) return std::vector{NamedPeer{0, place}};
    const auto& others = choice.file->others;
    if (others.size() == 1) return std::vector{NamedPeer{others.front().id, place}};
    return base::fail(fmt::format("{} knows {} other peers: say which one plays, with --peer "
                                  "ID=HOST:PORT instead of --remote, once for each that does",
                                  choice.path, others.size()));
}

base::Result<net::HostPort> place_of(const secure::KeyFile::Member& member, const std::string& path)
{
    auto place = net::parse_host_port(member.endpoint);
    if (place && place->port != 0) return place;
    return base::fail(fmt::format("{}: endpoint '{}' of peer {}: write HOST:PORT, such as "
                                  "10.0.0.2:7000",
                                  path, member.endpoint, member.id));
}

/// Returns all peers of the circle, at the addresses in the key file.
base::Result<std::vector<NamedPeer>> others_in(const KeyChoice& choice)
{
    const auto& members = choice.file->others;
    std::vector<NamedPeer> others;
    for (const secure::KeyFile::Member& member : members) {
        if (member.endpoint.empty() && members.size() == 1)
            return base::fail("--remote is required: --remote 127.0.0.1:7001");
        if (member.endpoint.empty()) {
            return base::fail(fmt::format("{} does not say where peer {} is: name those that play, "
                                          "with --peer ID=HOST:PORT once for each",
                                          choice.path, member.id));
        }
        auto place = place_of(member, choice.path);
        if (!place) return tl::unexpected{place.error()};
        others.push_back({member.id, *std::move(place)});
    }
    return others;
}

} // namespace

base::Result<NamedPeer> parse_named_peer(const std::string& text)
{
    const auto wrong = [&text] {
        return base::fail(fmt::format("'{}': write ID=HOST:PORT with an id from 1 to {}, such as "
                                      "2=10.0.0.2:7000",
                                      text, secure::KeyFile::id_max));
    };
    const auto equals = text.find('=');
    if (equals == std::string::npos) return wrong();
    const auto id = base::parse_count(text.substr(0, equals), secure::KeyFile::id_max);
    if (!id || *id == 0) return wrong();
    auto place = net::parse_host_port(text.substr(equals + 1));
    if (!place) return tl::unexpected{place.error()};
    if (place->port == 0) return wrong();
    return NamedPeer{static_cast<std::uint8_t>(*id), *std::move(place)};
}

void add_key_options(cli::Command& program, KeyChoice& choice)
{
    program.option(
        "--key", "FILE",
        "Play with the other peers of this key file alone, and seal all messages; needed "
        "where --listen or --remote is not loopback. hapnet-peer keygen makes one for "
        "each host",
        [&choice](const std::string& path) { return take_key(path, choice); });
    program.flag("--no-roam",
                 "With --key: stay with the address of --remote or --peer. Otherwise messages go "
                 "to where another peer was heard last",
                 choice.stays);
}

base::Result<std::vector<NamedPeer>> find_others(const KeyChoice& choice, const KeyedPlaces& places)
{
    if (!places.named.empty() && places.place)
        return base::fail("--peer and --remote both say where the other peer is: use one of them");
    if (!choice.is_given() && choice.stays)
        return base::fail("--no-roam needs --key: without a key a peer never roams");
    if (auto fine = check_named(choice, places.named); !fine) return tl::unexpected{fine.error()};
    if (places.place) return other_at(*places.place, choice);
    std::vector<NamedPeer> others = places.named;
    if (others.empty()) {
        if (!choice.is_given()) return base::fail("--remote is required: --remote 127.0.0.1:7001");
        auto all = others_in(choice);
        if (!all) return all;
        others = *std::move(all);
    }
    std::ranges::sort(others, {}, &NamedPeer::id);
    return others;
}

} // namespace hapnet::peer
