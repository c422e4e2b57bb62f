// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <system_error>

namespace hapnet::net {

/// The operation on an address that the system refused. It decides the advice, as one error number
/// has different causes: with EACCES, a port may not be bound or a file may not be written.
enum class AddressUse { bind, reach };

/// The category of system errors about addresses. All other errors are taken to be about files and
/// permissions.
[[nodiscard]] const std::error_category& errors_of(AddressUse use);

/// Returns the refusal of the system, with advice on what to do.
[[nodiscard]] std::string explained(const std::system_error& error);

/// Returns the refusal of a connection to a control socket, with advice on what to do.
[[nodiscard]] std::string explained_connection(const std::system_error& error);

} // namespace hapnet::net
