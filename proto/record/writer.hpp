// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/disk/descriptor.hpp"
#include "proto/record/codec.hpp"

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace hapnet::record {

/// Writes the record of one session to a file. Buffered: what was written since the last flush()
/// is lost when the process is killed. Allocates and blocks, so it has no place on the servo
/// thread. All of it throws std::system_error, naming the file, when the file refuses.
class Writer {
public:
    /// Creates the file, or empties it, and writes the header at once. A message of a row must have
    /// room in the layout. disk::open_to_write() says which files are refused.
    Writer(std::string path, const nlohmann::json& config, const Layout& layout = {});
    Writer(Writer&&) noexcept = default;
    Writer& operator=(Writer&&) = delete;
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    /// Writes what is buffered, if the file still takes it.
    ~Writer();

    void write(const Row& row);
    void flush();

    /// Rows that the file has. After it has refused it ends with the last of them.
    [[nodiscard]] std::uint64_t rows() const { return rows_; }

private:
    std::error_code try_flush() noexcept;
    [[noreturn]] void refuse(std::error_code error, const char* what) const;

    std::string path_;
    Layout layout_;
    disk::Descriptor file_;
    std::uint64_t bytes_ = 0; // length of the header and the rows in the file
    std::uint64_t rows_ = 0;
    std::string buffer_;
    std::vector<std::size_t> ends_; // ends of the rows in the buffer
};

} // namespace hapnet::record
