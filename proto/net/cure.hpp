// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <system_error>

namespace hapnet::net {

/// What the system refused, and what a person can do about it.
[[nodiscard]] std::string explained(const std::system_error& error);

/// The same of a control socket that a client could not connect to.
[[nodiscard]] std::string explained_connection(const std::system_error& error);

} // namespace hapnet::net
