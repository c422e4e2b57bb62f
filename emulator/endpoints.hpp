// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/options.hpp"
#include "proto/base/result.hpp"
#include "proto/net/address_set.hpp"
#include "proto/net/endpoint.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// The endpoints of both sides, resolved from names.
struct Endpoints {
    net::Endpoint listen_a;
    net::Endpoint listen_b;
    std::optional<net::Endpoint> a; // nullopt: adopt the first sender
    std::optional<net::Endpoint> b;
    std::optional<net::AddressSet> allowed_a{}; // senders that may be adopted
    std::optional<net::AddressSet> allowed_b{};
};

/// The endpoints of one of several links. The only link of a run has no name.
struct NamedEndpoints {
    std::string name;
    Endpoints endpoints;
};

/// A server, and the addresses that may be its clients.
struct ServerAndClients {
    net::Endpoint listen;
    net::Endpoint server;
    net::AddressSet allowed;
};

// These functions resolve names. The error is one of usage: combinations that cannot work or are
// not safe. They throw std::system_error when a name does not resolve or an endpoint cannot be
// reached.

[[nodiscard]] base::Result<std::vector<NamedEndpoints>> look_up(const Options& options);
[[nodiscard]] base::Result<std::vector<NamedEndpoints>> look_up(const LinkOptions& options);
[[nodiscard]] base::Result<ServerAndClients> look_up(const UpstreamOptions& options);

} // namespace hapnet::emulator
