// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace hapnet::lab::results {

/// A file of a result folder. For a file that was read, the path is one by which a person finds it.
/// For a file to be written, it is the path in the folder.
struct File {
    std::string path;
    std::string text;
};

} // namespace hapnet::lab::results
