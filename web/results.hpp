// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "web/reply.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hapnet::web {

/// The files of sessions and traps that pages may download. Only known kinds of files are included.
/// Pages name them by their place in a list, never by a path.
class Results {
public:
    static constexpr std::size_t files_max = 10'000;

    /// `out` is the folder that holds all files.
    explicit Results(std::string out) : out_{std::move(out)} {}

    /// Adds the new files in a folder of `out`, such as "run-1".
    void look_in(const std::string& folder, int run);

    /// These functions return the answers to GET /api/files and to GET /f/N.
    [[nodiscard]] Reply list() const;
    [[nodiscard]] Reply file(std::string_view path) const;

private:
    struct File {
        std::string name; // "run-1/peer-1.rec"
        std::string kind;
        int run = 0;
    };

    std::string out_;
    std::vector<File> files_; // never shortened or reordered
};

} // namespace hapnet::web
