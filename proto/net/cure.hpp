// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <system_error>

namespace hapnet::net {

/// The operation on an address that the system refused. One error number has different cures: for a
/// port that may not be bound, and for a file that may not be written.
enum class AddressUse { bind, reach };

/// The errors of the system about addresses. All others are taken to be about files and rights.
[[nodiscard]] const std::error_category& errors_of(AddressUse use);

/// Returns the refusal of the system, and what a person can do about it.
[[nodiscard]] std::string explained(const std::system_error& error);

/// Returns the refusal of a connection to a control socket, and what a person can do about it.
[[nodiscard]] std::string explained_connection(const std::system_error& error);

} // namespace hapnet::net
