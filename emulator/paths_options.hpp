// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/options.hpp"
#include "proto/base/result.hpp"
#include "proto/cli/command.hpp"
#include "proto/net/address_set.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace hapnet::emulator {

// The options of runs with several paths, and what they do not go with.

void add_upstream_options(cli::Command& program, UpstreamOptions& options);
void add_link_options(cli::Command& program, LinkOptions& options);
/// Adds the option --threads, which runs of both kinds have.
void add_threads(cli::Command& program, std::size_t& threads);

[[nodiscard]] base::Result<void> require_upstream(const cli::Command& program);
[[nodiscard]] base::Result<void> require_links(const LinkOptions& options,
                                               const cli::Command& program);

/// The path of a dry run, by the name of one of its ways, beside the flow that is named already.
[[nodiscard]] cli::Take into_path(std::string& path);
/// The flow of a dry run, or the rest, beside the path that is named already.
[[nodiscard]] cli::Take into_flow(std::string& path);

/// Patterns of addresses, one after the other.
[[nodiscard]] cli::Take allow_into(std::vector<net::AddressPattern>& into);

} // namespace hapnet::emulator
