// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/key_options.hpp"

#include "proto/base/text.hpp"
#include "proto/secure/keys/files.hpp"
#include "proto/secure/keys/process.hpp"

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

/// Who the other peer is; an error when the key file leaves that open.
base::Result<std::uint8_t> other_of(const KeyChoice& choice, const std::optional<NamedPeer>& named)
{
    const secure::KeyFile& file = *choice.file;
    if (!named) {
        if (file.others.size() == 1) return file.others.front().id;
        return base::fail(fmt::format("{} knows {} other peers: say which one plays, with --peer "
                                      "ID=HOST:PORT instead of --remote",
                                      choice.path, file.others.size()));
    }
    if (file.find(named->id) != nullptr) return named->id;
    return base::fail(
        fmt::format("--peer: {} knows no peer {}: 'hapnet-peer key show {}' lists them",
                    choice.path, named->id, choice.path));
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
    program.option("--key", "FILE",
                   "Play with the other peer of this key file alone, and seal all messages; needed "
                   "where --listen or --remote is not loopback. hapnet-peer keygen makes one for "
                   "each host",
                   [&choice](const std::string& path) { return take_key(path, choice); });
    program.flag("--no-roam",
                 "With --key: stay with the address of --remote. Otherwise messages go to where "
                 "the other peer was heard last",
                 choice.stays);
}

base::Result<net::HostPort> check_key_options(KeyChoice& choice, const KeyedPlaces& places)
{
    if (places.named && places.place)
        return base::fail("--peer and --remote both say where the other peer is: use one of them");
    if (choice.is_given()) {
        const auto other = other_of(choice, places.named);
        if (!other) return tl::unexpected{other.error()};
        choice.other = *other;
    } else if (choice.stays) {
        return base::fail("--no-roam needs --key: without a key a peer never roams");
    }
    if (places.place) return *places.place;
    if (places.named) return places.named->place;
    const auto* member = choice.is_given() ? choice.file->find(choice.other) : nullptr;
    if (member == nullptr || member->endpoint.empty())
        return base::fail("--remote is required: --remote 127.0.0.1:7001");
    auto place = net::parse_host_port(member->endpoint);
    if (place && place->port != 0) return place;
    return base::fail(fmt::format("{}: endpoint '{}' of peer {}: write HOST:PORT, such as "
                                  "10.0.0.2:7000",
                                  choice.path, member->endpoint, member->id));
}

} // namespace hapnet::peer
