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
#include <vector>

namespace hapnet::peer {

/// The key of a session, as the command line asks for it.
struct KeyChoice {
    std::shared_ptr<const secure::KeyFile> file; // null: no key
    std::string path;
    bool stays = false; // --no-roam: messages go only to the places given for the others

    [[nodiscard]] bool is_given() const { return file != nullptr; }
};

/// Another peer and its place, as `--peer ID=HOST:PORT` gives them.
struct NamedPeer {
    std::uint8_t id = 0; // 0: any peer that answers at the place
    net::HostPort place;
};
[[nodiscard]] base::Result<NamedPeer> parse_named_peer(const std::string& text);

/// Adds --key and --no-roam, bound to `choice`. The file is read at once; from then on this process
/// leaves no core dump.
void add_key_options(cli::Command& program, KeyChoice& choice);

/// The places of the other peers, as far as the command line gives them.
struct KeyedPlaces {
    std::vector<NamedPeer> named;       // --peer
    std::optional<net::HostPort> place; // --remote
};
/// Returns the other peers by their ids, ascending. Call it after the command line was read. If
/// peers are named there, only these play. Otherwise all peers of the key file play, and it must
/// give their places. The error says what is missing or does not fit.
[[nodiscard]] base::Result<std::vector<NamedPeer>> find_others(const KeyChoice& choice,
                                                               const KeyedPlaces& places);

} // namespace hapnet::peer
