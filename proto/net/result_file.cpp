// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/result_file.hpp"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::net {

namespace {

[[noreturn]] void refuse(int error, const std::string& path)
{
    throw std::system_error{error, std::generic_category(), fmt::format("cannot write {}", path)};
}

} // namespace

ResultFile::ResultFile(std::string path, unsigned mode) : path_{std::move(path)}
{
    struct stat found {};
    if (stat(path_.c_str(), &found) == 0) {
        if (S_ISDIR(found.st_mode)) refuse(EISDIR, path_);
        if (!S_ISREG(found.st_mode)) {
            descriptor_ = open(path_.c_str(), O_WRONLY | O_CLOEXEC);
            if (descriptor_ < 0) refuse(errno, path_);
            return;
        }
        std::error_code error; // it exists: nothing to go wrong but a race
        path_ = std::filesystem::canonical(path_, error).string();
        if (error) refuse(error.value(), path_);
    }
    temporary_ = fmt::format("{}.{}.partial", path_, getpid());
    descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, mode);
    if (descriptor_ < 0) refuse(errno, path_);
}

ResultFile::~ResultFile()
{
    if (descriptor_ < 0) return;
    close(descriptor_);
    if (!temporary_.empty()) unlink(temporary_.c_str());
}

void ResultFile::append(std::string_view text)
{
    while (!text.empty()) {
        const auto count = write(descriptor_, text.data(), text.size());
        if (count < 0 && errno != EINTR) refuse(errno, path_);
        if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
    }
}

void ResultFile::commit(std::string_view text)
{
    append(text);
    const bool moves = !temporary_.empty();
    if (moves && std::rename(temporary_.c_str(), path_.c_str()) != 0) refuse(errno, path_);
    close(std::exchange(descriptor_, -1));
}

} // namespace hapnet::net
