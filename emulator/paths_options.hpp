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

// The options of runs with several paths, and the options that they exclude.

void add_upstream_options(cli::Command& program, UpstreamOptions& options);
void add_link_options(cli::Command& program, LinkOptions& options);
/// Adds the option --threads, which runs of both kinds have.
void add_threads(cli::Command& program, std::size_t& threads);

[[nodiscard]] base::Result<void> require_upstream(const cli::Command& program);
[[nodiscard]] base::Result<void> require_links(const LinkOptions& options,
                                               const cli::Command& program);

/// Stores the path of a dry run, given by the name of one of its directions, in `path`. A flow that
/// `path` names already stays.
[[nodiscard]] cli::Take into_path(std::string& path);
/// Stores the flow of a dry run, or "rest", in `path`. A path that `path` names already stays.
[[nodiscard]] cli::Take into_flow(std::string& path);

/// Adds patterns of addresses to `into`, one after the other.
[[nodiscard]] cli::Take allow_into(std::vector<net::AddressPattern>& into);

} // namespace hapnet::emulator
