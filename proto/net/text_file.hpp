// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <string>

namespace hapnet::net {

/// The whole text of a file of at most 256 MiB; the error names it and says why it cannot be read.
[[nodiscard]] base::Result<std::string> text_of_file(const std::string& path);

/// Opens files by names from another program, only below one folder. A name that leads out of it,
/// through "..", from the root or by a symbolic link, opens no file and reveals nothing about it.
class Folder {
public:
    /// Throws std::system_error when it cannot be opened.
    explicit Folder(const std::string& path);
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    /// The whole text of a regular file below it, of at most 256 MiB. The name may also begin with
    /// the path of the folder.
    [[nodiscard]] base::Result<std::string> text_of(const std::string& name) const;

private:
    std::string path_;
    int descriptor_;
};

} // namespace hapnet::net
