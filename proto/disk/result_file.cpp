// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/disk/result_file.hpp"

#include "proto/base/text.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <limits>
#include <spdlog/fmt/fmt.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::disk {

namespace {

[[noreturn]] void cannot_write(int error, const std::string& path, std::string_view option = "")
{
    throw std::system_error{
        error, std::generic_category(),
        fmt::format("{}{}cannot write {}", option, option.empty() ? "" : ": ", path)};
}

/// Whether the process of a "PID" has ended, as far as can be seen from here.
bool has_ended(std::string_view pid)
{
    const auto number = base::parse_count(pid, std::numeric_limits<pid_t>::max());
    return number && *number > 0 && kill(static_cast<pid_t>(*number), 0) != 0 && errno == ESRCH;
}

/// Removes what killed processes have left of `path`.
void remove_leftovers(const std::string& path)
{
    namespace fs = std::filesystem;
    constexpr std::string_view end = ".partial";
    const fs::path place{path};
    const auto beginning = place.filename().string() + ".";
    std::error_code error;
    const auto folder = place.has_parent_path() ? place.parent_path() : fs::path{"."};
    for (fs::directory_iterator entry{folder, error}, last; !error && entry != last;
         entry.increment(error)) {
        const auto name = entry->path().filename().string();
        if (name.size() <= beginning.size() + end.size()) continue;
        if (!name.starts_with(beginning) || !name.ends_with(end)) continue;
        const auto pid = std::string_view{name}.substr(beginning.size(),
                                                       name.size() - beginning.size() - end.size());
        if (!has_ended(pid)) continue;
        const int descriptor = open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
        if (descriptor < 0) continue;
        if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) unlink(entry->path().c_str());
        close(descriptor);
    }
}

} // namespace

ResultFile::ResultFile(std::string path, std::string_view option, unsigned mode)
    : path_{std::move(path)}
{
    struct stat found {};
    if (stat(path_.c_str(), &found) == 0) {
        if (S_ISDIR(found.st_mode)) cannot_write(EISDIR, path_, option);
        if (!S_ISREG(found.st_mode)) {
            descriptor_ = open(path_.c_str(), O_WRONLY | O_CLOEXEC);
            if (descriptor_ < 0) cannot_write(errno, path_, option);
            return;
        }
        std::error_code error; // it exists: nothing to go wrong but a race
        path_ = std::filesystem::canonical(path_, error).string();
        if (error) cannot_write(error.value(), path_, option);
    }
    remove_leftovers(path_);
    temporary_ = fmt::format("{}.{}.partial", path_, getpid());
    descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, mode);
    if (descriptor_ < 0) cannot_write(errno, path_, option);
    flock(descriptor_, LOCK_EX | LOCK_NB); // says that somebody is at it, also across containers
}

ResultFile::~ResultFile()
{
    if (descriptor_ < 0) return;
    close(descriptor_);
    if (!temporary_.empty()) unlink(temporary_.c_str());
}

void ResultFile::append(std::string_view text)
{
    const auto length = static_cast<off_t>(text.size());
    while (!text.empty()) {
        const auto count = write(descriptor_, text.data(), text.size());
        if (count < 0 && errno != EINTR) {
            const int error = errno;
            if (!temporary_.empty() && ftruncate(descriptor_, length_) == 0) {
                lseek(descriptor_, length_, SEEK_SET);
            }
            cannot_write(error, path_);
        }
        if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
    }
    length_ += length;
}

void ResultFile::keep() noexcept
{
    if (temporary_.empty() || descriptor_ < 0 || length_ == 0) return;
    if (std::rename(temporary_.c_str(), path_.c_str()) == 0) close(std::exchange(descriptor_, -1));
}

void ResultFile::commit(std::string_view text)
{
    append(text);
    const bool moves = !temporary_.empty();
    if (moves && std::rename(temporary_.c_str(), path_.c_str()) != 0) cannot_write(errno, path_);
    close(std::exchange(descriptor_, -1));
}

} // namespace hapnet::disk
