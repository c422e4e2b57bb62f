// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/record/writer.hpp"

#include "proto/disk/create.hpp"
#include "proto/record/header.hpp"

#include <cerrno>
#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <tuple>
#include <unistd.h>
#include <utility>

namespace hapnet::record {

namespace {

constexpr std::size_t buffer_bytes = 16384;

/// Empties a regular file after locking it, because two peers with the same file name must not
/// spoil each other's record. Returns the error.
int take_alone(int file)
{
    struct stat found {};
    if (fstat(file, &found) != 0) return errno;
    if (!S_ISREG(found.st_mode)) return 0;
    return flock(file, LOCK_EX | LOCK_NB) == 0 && ftruncate(file, 0) == 0 ? 0 : errno;
}

} // namespace

Writer::Writer(std::string path, const nlohmann::json& config, const Layout& layout)
    : path_{std::move(path)}, layout_{layout}
{
    auto opened = disk::open_to_write(path_, O_WRONLY, 0644);
    if (!opened) refuse(opened.error(), "create");
    file_ = *std::move(opened);
    if (const int error = take_alone(file_.number()); error != 0) {
        refuse({error, std::generic_category()},
               error == EWOULDBLOCK ? "create (another program is writing)" : "create");
    }
    buffer_ = header_line(config, layout_) + '\n';
    ends_.push_back(buffer_.size());
    flush();
    rows_ = 0; // the header does not count as a row
}

Writer::~Writer()
{
    if (file_.is_open()) std::ignore = try_flush();
}

void Writer::write(const Row& row)
{
    const RowBytes bytes = encode(row, layout_);
    buffer_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    ends_.push_back(buffer_.size());
    if (buffer_.size() >= buffer_bytes) flush();
}

void Writer::flush()
{
    if (const auto error = try_flush()) refuse(error, "write");
}

/// Discards rows that cannot be written.
std::error_code Writer::try_flush() noexcept
{
    const auto written = disk::write_all(file_.number(), buffer_);
    std::size_t whole = 0;
    for (const std::size_t end : ends_) {
        if (end > written.bytes) break;
        whole = end;
        ++rows_;
    }
    bytes_ += whole;
    buffer_.clear();
    ends_.clear();
    if (whole < written.bytes) // removes a row that is cut off
        std::ignore = ftruncate(file_.number(), static_cast<off_t>(bytes_));
    return written.error;
}

void Writer::refuse(std::error_code error, const char* what) const
{
    throw std::system_error{error, fmt::format("cannot {} the record {}", what, path_)};
}

} // namespace hapnet::record
