// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace hapnet::disk {

/// A kind of file with a secret: its name in messages, its largest size, and whether links are
/// allowed.
struct PrivateKind {
    enum class Links : std::uint8_t { refused, followed };

    std::string_view name; // such as "key file"
    std::size_t bytes_max = 0;
    Links links = Links::refused;
};

/// Reads a regular file with a secret. It must belong to this user or to root, and no other user
/// and no group may read or write it. Both its mode and its access control list (acl(5)) count: by
/// the latter, systemd lets the user of a service read credentials that belong to root. The error
/// says what is wrong, and which command mends it.
[[nodiscard]] base::Result<std::string> read_private(const std::string& path,
                                                     const PrivateKind& kind);

} // namespace hapnet::disk
