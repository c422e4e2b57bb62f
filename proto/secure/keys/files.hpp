// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/secure/key_file.hpp"

#include <string>

namespace hapnet::secure::keys {

/// Reads a key file. Refuses a file that another user or a group may read or write
/// (disk::read_private()), that is a symbolic link or not a regular file, or that is larger than 64
/// KiB. The complaint gives the command that corrects this.
[[nodiscard]] base::Result<KeyFile> read_key_file(const std::string& path);

/// Writes a new key file with mode 0600. Never replaces a file. Throws std::system_error naming the
/// file if it cannot be written.
void write_key_file(const std::string& path, const KeyFile& file);
/// Replaces an existing key file completely or not at all. Throws like write_key_file().
void replace_key_file(const std::string& path, const KeyFile& file);

/// Reads a file with only a circle's shared key, which is carried to the hosts that do not have it
/// yet. Such files are read and written like key files.
[[nodiscard]] base::Result<Secret> read_shared_key(const std::string& path);
void write_shared_key(const std::string& path, const Secret& key);

} // namespace hapnet::secure::keys
