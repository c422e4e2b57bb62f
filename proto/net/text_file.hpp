// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <string>

namespace hapnet::net {

/// Returns the content of a file of at most 256 MiB. The error names the file and says why it
/// cannot be read.
[[nodiscard]] base::Result<std::string> text_of_file(const std::string& path);

/// Opens files whose names come from another program, only below one folder. A name that leads out
/// of the folder (by "..", as an absolute path or by a symbolic link) opens no file and reveals
/// nothing about it.
class Folder {
public:
    /// Throws std::system_error if the folder cannot be opened.
    explicit Folder(const std::string& path);
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    /// Returns the content of a regular file below the folder, of at most 256 MiB. The name may
    /// also begin with the path of the folder.
    [[nodiscard]] base::Result<std::string> text_of(const std::string& name) const;

private:
    std::string path_;
    int descriptor_;
};

} // namespace hapnet::net
