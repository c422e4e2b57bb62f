// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/options.hpp"
#include "emulator/ports/upstream.hpp"
#include "proto/base/result.hpp"
#include "proto/net/endpoint.hpp"

#include <optional>

namespace hapnet::emulator {

/// Who stands on each side, looked up.
struct Endpoints {
    net::Endpoint listen_a;
    net::Endpoint listen_b;
    std::optional<net::Endpoint> a;
    std::optional<net::Endpoint> b;
};

/// Looks up the names. The error is one of usage: combinations that cannot work or are not safe.
/// Throws std::system_error when a name does not resolve or an endpoint cannot be reached.
[[nodiscard]] base::Result<Endpoints> look_up(const Options& options);

/// The same of a server and its clients.
[[nodiscard]] base::Result<ports::Upstream::Places> look_up(const UpstreamOptions& options);

} // namespace hapnet::emulator
