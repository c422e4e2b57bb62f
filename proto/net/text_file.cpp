// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/text_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <linux/openat2.h>
#include <spdlog/fmt/fmt.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::net {

namespace {

constexpr std::size_t bytes_max = std::size_t{256} << 20;

tl::unexpected<base::Error> cannot_read(const std::string& path, const char* why)
{
    return base::fail(fmt::format("cannot read {}: {}", path, why));
}

/// Reads the text behind a descriptor, and closes it. If the descriptor is -1, returns the error in
/// errno.
base::Result<std::string> text_behind(int descriptor, const std::string& path, bool only_regular)
{
    if (descriptor < 0) return cannot_read(path, std::strerror(errno));
    const auto read_all = [&]() -> base::Result<std::string> {
        struct stat found {};
        if (fstat(descriptor, &found) != 0) return cannot_read(path, std::strerror(errno));
        if (S_ISDIR(found.st_mode)) return cannot_read(path, "it is a folder");
        if (only_regular && !S_ISREG(found.st_mode)) {
            return cannot_read(path, "it is not a regular file");
        }
        std::string text;
        if (found.st_size > 0)
            text.reserve(std::min(static_cast<std::size_t>(found.st_size), bytes_max));
        // NOLINTNEXTLINE(*-member-init): only what is read is used
        std::array<char, std::size_t{64} << 10> block;
        for (;;) {
            const auto count = ::read(descriptor, block.data(), block.size());
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) return cannot_read(path, std::strerror(errno));
            if (count == 0) return text;
            text.append(block.data(), static_cast<std::size_t>(count));
            if (text.size() > bytes_max) return cannot_read(path, "it is larger than 256 MiB");
        }
    };
    auto text = read_all();
    close(descriptor);
    return text;
}

} // namespace

base::Result<std::string> text_of_file(const std::string& path)
{
    return text_behind(open(path.c_str(), O_RDONLY | O_CLOEXEC), path, false);
}

Folder::Folder(const std::string& path)
    : path_{std::filesystem::path{path}.lexically_normal().string()},
      descriptor_{open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)}
{
    if (descriptor_ < 0) {
        throw std::system_error{errno, std::generic_category(),
                                fmt::format("cannot open the folder {}", path)};
    }
    while (path_.size() > 1 && path_.ends_with('/')) path_.pop_back();
}

Folder::~Folder() { close(descriptor_); }

base::Result<std::string> Folder::text_of(const std::string& name) const
{
    const bool names_folder =
        name.size() > path_.size() + 1 && name.starts_with(path_) && name[path_.size()] == '/';
    const std::string below = names_folder ? name.substr(path_.size() + 1) : name;
    // A pipe without a writer must not block the thread that opens it.
    open_how how{};
    how.flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;
    how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
    const auto opened = syscall(SYS_openat2, descriptor_, below.c_str(), &how, sizeof how);
    if (opened < 0 && (errno == EXDEV || errno == ELOOP)) {
        return cannot_read(name, "it is not below the folder of files that may be named");
    }
    if (opened < 0 && errno == ENOSYS) {
        return cannot_read(name, "this system cannot keep names within a folder (openat2 is "
                                 "missing: Linux 5.6 has it)");
    }
    return text_behind(static_cast<int>(opened), name, true);
}

} // namespace hapnet::net
