// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/record/writer.hpp"

#include "proto/record/header.hpp"

#include <cerrno>
#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::record {

namespace {

/// The file, emptied; null with errno set when it cannot be had. Locked before it is emptied: two
/// peers that were given one name must not spoil each other's record.
std::FILE* open_alone(const std::string& path)
{
    const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor < 0) return nullptr;
    struct stat found {};
    const bool is_regular = fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode);
    const bool is_ours =
        !is_regular || (flock(descriptor, LOCK_EX | LOCK_NB) == 0 && ftruncate(descriptor, 0) == 0);
    if (is_ours) return fdopen(descriptor, "wb");
    const int error = errno;
    close(descriptor);
    errno = error;
    return nullptr;
}

} // namespace

Writer::Writer(std::string path, const nlohmann::json& config, const Layout& layout)
    : path_{std::move(path)}, layout_{layout}, file_{open_alone(path_)}
{
    if (!file_) refuse(errno == EWOULDBLOCK ? "create (another program is writing)" : "create");
    const std::string header = header_line(config, layout_) + '\n';
    put(header.data(), header.size());
    flush();
}

void Writer::write(const Row& row)
{
    const RowBytes bytes = encode(row, layout_);
    put(bytes.data(), bytes.size());
}

void Writer::flush()
{
    if (std::fflush(file_.get()) != 0) refuse("write");
}

void Writer::put(const void* data, std::size_t size)
{
    if (std::fwrite(data, 1, size, file_.get()) != size) refuse("write");
}

void Writer::refuse(const char* what) const
{
    throw std::system_error{errno, std::generic_category(),
                            fmt::format("cannot {} the record {}", what, path_)};
}

} // namespace hapnet::record
