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

/// Writes the record of one session to a file. Output is buffered: rows written since the last
/// flush() are lost if the process is killed. Do not use it on the servo thread, because it
/// allocates and blocks. Each function throws std::system_error naming the file if the file cannot
/// be written.
class Writer {
public:
    /// Creates or empties the file, and writes the header at once. The layout must have room for
    /// the message of each row. disk::open_to_write() says which files are refused.
    Writer(std::string path, const nlohmann::json& config, const Layout& layout = {});
    Writer(Writer&&) noexcept = default;
    Writer& operator=(Writer&&) = delete;
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    /// Writes the buffered rows, if the file still accepts them.
    ~Writer();

    void write(const Row& row);
    void flush();

    /// Returns the number of rows in the file. After a failed write, the file ends with the last of
    /// them.
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
