// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/record/codec.hpp"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace hapnet::record {

/// Writes the record of one session to a file. Buffered: what was written since the last flush()
/// is lost when the process is killed. Allocates and blocks, so it has no place on the servo
/// thread. All of it throws std::system_error, naming the file, when the file refuses.
class Writer {
public:
    /// Creates the file, or empties it, and writes the header at once. A message of a row must have
    /// room in the layout.
    Writer(std::string path, const nlohmann::json& config, const Layout& layout = {});

    void write(const Row& row);
    void flush();

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    void put(const void* data, std::size_t size);
    [[noreturn]] void refuse(const char* what) const;

    std::string path_;
    Layout layout_;
    std::unique_ptr<std::FILE, Close> file_;
};

} // namespace hapnet::record
