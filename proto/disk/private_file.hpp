// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace hapnet::disk {

/// The kind of a file with a secret: its name in messages, its largest size, and its rule for
/// links.
struct PrivateKind {
    enum class Links : std::uint8_t { refused, followed };

    std::string_view name; // such as "key file"
    std::size_t bytes_max = 0;
    Links links = Links::refused;
};

/// Reads a regular file that holds a secret. It belongs to this user or to root, and no other user
/// and no group may read or write it: neither by its mode nor by its access control list
/// (acl(5)), by which systemd lets the user of a service read credentials that belong to root. The
/// error says what is wrong, and the command that mends it.
[[nodiscard]] base::Result<std::string> read_private(const std::string& path,
                                                     const PrivateKind& kind);

} // namespace hapnet::disk
