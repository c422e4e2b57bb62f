// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/net/address_set.hpp"
#include "proto/net/endpoint.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// One of several links: `--link 1-2=LISTEN_1,LISTEN_2,END_1,END_2`
struct TypedLink {
    std::string name;
    net::HostPort listen_1;
    net::HostPort listen_2;
    std::vector<net::AddressPattern> end_1; // none: adopt the first sender
    std::vector<net::AddressPattern> end_2;
};
[[nodiscard]] base::Result<TypedLink> parse_link(std::string_view text);

/// The greatest number of links: one for each pair of eight peers.
inline constexpr std::size_t links_max = 28;

/// Refuses too many links, and two links with the same name or address.
[[nodiscard]] base::Result<void> require_different(std::span<const TypedLink> links);

} // namespace hapnet::emulator
