// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace hapnet::web {

/// A file of the page that is compiled into the program.
struct Asset {
    std::string_view name; // "app.js", "paint/arrows.js"
    std::string_view bytes;
    std::string_view packed; // compressed by gzip; empty: gzip does not make it smaller
};

/// All files of the page. The build generates the file that defines them.
[[nodiscard]] std::span<const Asset> assets();

/// Returns the media type for a file name, by its ending.
[[nodiscard]] std::string_view media_type(std::string_view name);

/// The page as it is served, and the paths of its files.
class Page {
public:
    Page();

    /// Returns index.html. In the source, @@FILE@@ stands for the path of FILE, or for "" without
    /// such a file.
    [[nodiscard]] const std::string& index() const { return index_; }
    /// Returns the file at a path; nullptr: there is none.
    [[nodiscard]] const Asset* find(std::string_view path) const;
    /// Returns a hash of all files together, in hexadecimal digits. It is part of their paths.
    [[nodiscard]] const std::string& hash() const { return hash_; }

private:
    std::string hash_;
    std::string index_;
};

} // namespace hapnet::web
