// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <system_error>

namespace hapnet::net {

/// What the system refused to do with an address. A cure depends on it: a port that may not be
/// bound to needs another one than a file that may not be written, for the same number of an error.
enum class AddressUse { bind, reach };

/// The errors of the system about addresses. All others are taken to be about files and rights.
[[nodiscard]] const std::error_category& errors_of(AddressUse use);

/// What the system refused, and what a person can do about it.
[[nodiscard]] std::string explained(const std::system_error& error);

/// The same of a control socket that a client could not connect to.
[[nodiscard]] std::string explained_connection(const std::system_error& error);

} // namespace hapnet::net
