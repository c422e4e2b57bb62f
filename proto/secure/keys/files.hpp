// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/secure/key_file.hpp"

#include <string>

namespace hapnet::secure::keys {

/// Reads a key file. Refuses one that another user or a group may read or write
/// (disk::read_private()), that is a symbolic link or no regular file, or that is larger than 64
/// KiB; the complaint says the command that mends it.
[[nodiscard]] base::Result<KeyFile> read_key_file(const std::string& path);

/// Writes a new key file with mode 0600. Refuses to replace one. Throws std::system_error naming
/// the file when it cannot be written.
void write_key_file(const std::string& path, const KeyFile& file);
/// Exchanges a key file that is there, whole or not at all. Throws as above.
void replace_key_file(const std::string& path, const KeyFile& file);

/// A file that holds a circle's shared key alone, and travels to the hosts that do not have it yet.
/// Read and written as key files are.
[[nodiscard]] base::Result<Secret> read_shared_key(const std::string& path);
void write_shared_key(const std::string& path, const Secret& key);

} // namespace hapnet::secure::keys
