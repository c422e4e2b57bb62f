// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/cli/command.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/secure/key_file.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace hapnet::peer {

/// The key of a session, as the command line asks for it.
struct KeyChoice {
    std::shared_ptr<const secure::KeyFile> file; // null: none
    std::string path;
    std::uint8_t other = 0; // the id of the other peer, once check_key_options() has found it
    bool stays = false;     // the other peer is heard from --remote alone

    [[nodiscard]] bool is_given() const { return file != nullptr; }
};

/// `--peer ID=HOST:PORT`
struct NamedPeer {
    std::uint8_t id = 0;
    net::HostPort place;
};
[[nodiscard]] base::Result<NamedPeer> parse_named_peer(const std::string& text);

/// Adds --key and --no-roam, bound to `choice`. The file is read at once; from then on this process
/// leaves no core dump.
void add_key_options(cli::Command& program, KeyChoice& choice);

/// After the command line was read: finds the other peer in the key file, and where it is, if the
/// file says so and the command line does not. Says what is missing or does not fit.
struct KeyedPlaces {
    std::optional<NamedPeer> named;     // --peer
    std::optional<net::HostPort> place; // --remote
};
[[nodiscard]] base::Result<net::HostPort> check_key_options(KeyChoice& choice,
                                                            const KeyedPlaces& places);

} // namespace hapnet::peer
