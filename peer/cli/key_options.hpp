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

/// The options of the command line about the key of a session.
struct KeyChoice {
    std::shared_ptr<const secure::KeyFile> file; // nullptr: no key
    std::string path;
    bool stays = false; // --no-roam: send only to the given places of the others

    [[nodiscard]] bool is_given() const { return file != nullptr; }
};

/// Another peer and its address, from `--peer ID=HOST:PORT`.
struct NamedPeer {
    std::uint8_t id = 0; // 0: any peer that answers at that address
    net::HostPort place;
};
[[nodiscard]] base::Result<NamedPeer> parse_named_peer(const std::string& text);

/// Adds --key and --no-roam, bound to `choice`. The file is read at once; from then on this process
/// leaves no core dump.
void add_key_options(cli::Command& program, KeyChoice& choice);

/// The addresses of the other peers that the command line gives.
struct KeyedPlaces {
    std::vector<NamedPeer> named;       // --peer
    std::optional<net::HostPort> place; // --remote
};
/// Returns the other peers, sorted by their ids. Call it after parsing. If the command line names
/// peers, only these take part. Otherwise all peers of the key file take part, and the file must
/// give their addresses. The error says what is missing or inconsistent.
[[nodiscard]] base::Result<std::vector<NamedPeer>> find_others(const KeyChoice& choice,
                                                               const KeyedPlaces& places);

} // namespace hapnet::peer
