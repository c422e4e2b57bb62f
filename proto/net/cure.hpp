// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <system_error>

namespace hapnet::net {

/// What the system refused, and what a person can do about it.
[[nodiscard]] std::string explained(const std::system_error& error);

} // namespace hapnet::net
