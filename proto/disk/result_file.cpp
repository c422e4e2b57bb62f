// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/disk/result_file.hpp"

#include "proto/base/text.hpp"
#include "proto/disk/create.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <dirent.h>
#include <fcntl.h>
#include <limits>
#include <memory>
#include <spdlog/fmt/fmt.h>
#include <sys/file.h>
#include <unistd.h>
#include <utility>

namespace hapnet::disk {

namespace {

constexpr std::string_view ending = ".partial";

std::error_code last_error() { return {errno, std::generic_category()}; }

[[noreturn]] void cannot_write(std::error_code error, const std::string& path,
                               std::string_view option = "")
{
    throw std::system_error{
        error, fmt::format("{}{}cannot write {}", option, option.empty() ? "" : ": ", path)};
}

/// True if the process with this "PID" has ended, as far as this process can see.
bool has_ended(std::string_view pid)
{
    const auto number = base::parse_count(pid, std::numeric_limits<pid_t>::max());
    return number && *number > 0 && kill(static_cast<pid_t>(*number), 0) != 0 && errno == ESRCH;
}

/// True for the temporary name of `file` if the process that wrote it has ended.
bool is_leftover(std::string_view name, std::string_view file)
{
    if (name.size() <= file.size() + ending.size() || !name.starts_with(file)) return false;
    name.remove_prefix(file.size());
    if (!name.starts_with('.') || !name.ends_with(ending)) return false;
    name.remove_prefix(1);
    return has_ended(name.substr(0, name.find('.')));
}

/// Removes temporary files that killed processes have left.
void remove_leftovers(const Place& place)
{
    const int again = openat(place.folder(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const std::unique_ptr<DIR, int (*)(DIR*)> folder{again < 0 ? nullptr : fdopendir(again),
                                                     closedir};
    if (!folder) return;
    while (const dirent* entry = readdir(folder.get())) { // NOLINT(concurrency-mt-unsafe)
        const char* name = static_cast<const char*>(entry->d_name);
        if (!is_leftover(name, place.name())) continue;
        constexpr int flags = O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
        const Descriptor file{openat(place.folder(), name, flags)};
        struct stat found {};
        const bool is_ours = file.is_open() && fstat(file.number(), &found) == 0 &&
                             S_ISREG(found.st_mode) && found.st_uid == geteuid();
        // If it is locked, its writer is in another container, where it has that number.
        if (is_ours && flock(file.number(), LOCK_EX | LOCK_NB) == 0)
            unlinkat(place.folder(), name, 0);
    }
}

} // namespace

ResultFile::ResultFile(std::string path, std::string_view option, unsigned mode)
    : path_{std::move(path)}
{
    auto place = Place::find(path_);
    if (!place) cannot_write(place.error(), path_, option);
    place_.emplace(*std::move(place));
    if (place_->found() && (!place_->is_regular() || place_->is_open_file())) {
        auto opened = open_to_write(*place_, O_WRONLY, mode);
        if (!opened) cannot_write(opened.error(), path_, option);
        file_ = *std::move(opened);
        return;
    }
    if (const auto error = place_->why_not_replaced()) cannot_write(error, path_, option);
    remove_leftovers(*place_);
    const auto name = fmt::format("{}.{}.{}{}", place_->name(), getpid(), random_letters(), ending);
    auto created = create_beside(*place_, name, O_WRONLY, mode);
    if (!created) cannot_write(created.error(), path_, option);
    file_ = *std::move(created);
    temporary_ = name;
    flock(file_.number(), LOCK_EX | LOCK_NB); // marks the file as in use, also for containers
}

ResultFile::~ResultFile()
{
    if (file_.is_open() && !temporary_.empty()) unlinkat(place_->folder(), temporary_.c_str(), 0);
}

void ResultFile::append(std::string_view text)
{
    if (const auto error = write_all(file_.number(), text).error) {
        if (!temporary_.empty() && ftruncate(file_.number(), length_) == 0)
            lseek(file_.number(), length_, SEEK_SET);
        cannot_write(error, path_);
    }
    length_ += static_cast<off_t>(text.size());
}

bool ResultFile::keep() noexcept
{
    if (temporary_.empty() || !file_.is_open() || length_ == 0) return false;
    const int folder = place_->folder();
    if (renameat(folder, temporary_.c_str(), folder, place_->name().c_str()) != 0) return false;
    file_ = Descriptor{};
    return true;
}

void ResultFile::commit(std::string_view text)
{
    append(text);
    move();
}

void ResultFile::commit_to_disk(std::string_view text)
{
    append(text);
    if (!temporary_.empty() && fsync(file_.number()) != 0) cannot_write(last_error(), path_);
    move();
}

void ResultFile::move()
{
    const int folder = place_->folder();
    const char* name = place_->name().c_str();
    if (!temporary_.empty() && renameat(folder, temporary_.c_str(), folder, name) != 0)
        cannot_write(last_error(), path_);
    file_ = Descriptor{};
}

} // namespace hapnet::disk
