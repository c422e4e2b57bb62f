// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace hapnet::lab::results {

/// A file of a result folder: as it was read, with a path that a person finds it by, or to be
/// written, with its path in the folder.
struct File {
    std::string path;
    std::string text;
};

} // namespace hapnet::lab::results
