// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/disk/create.hpp"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <sys/random.h>
#include <unistd.h>

namespace hapnet::disk {

namespace {

Outcome<Descriptor> opened(int number)
{
    if (number >= 0) return Descriptor{number};
    return tl::unexpected{std::error_code{errno, std::generic_category()}};
}

} // namespace

Outcome<Descriptor> create(const Place& place, int flags, mode_t mode)
{
    return create_beside(place, place.name(), flags, mode);
}

Outcome<Descriptor> create_beside(const Place& place, const std::string& name, int flags,
                                  mode_t mode)
{
    flags |= O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
    return opened(openat(place.folder(), name.c_str(), flags, mode));
}

Outcome<Descriptor> open_to_write(const Place& place, int flags, mode_t mode)
{
    if (!place.found()) return create(place, flags, mode);
    if (const auto error = place.why_not_written_to(mode)) return tl::unexpected{error};
    flags |= O_CLOEXEC | O_NOCTTY | (place.is_open_file() ? 0 : O_NOFOLLOW);
    auto file = opened(openat(place.folder(), place.name().c_str(), flags));
    if (!file) return file;
    struct stat now {};
    if (fstat(file->number(), &now) != 0)
        return tl::unexpected{std::error_code{errno, std::generic_category()}};
    const bool is_same = now.st_ino == place.found()->st_ino && now.st_dev == place.found()->st_dev;
    if (!is_same) return tl::unexpected{std::error_code{ESTALE, std::generic_category()}};
    return file;
}

Outcome<Descriptor> open_to_write(const std::string& path, int flags, mode_t mode)
{
    const auto place = Place::find(path);
    if (!place) return tl::unexpected{place.error()};
    return open_to_write(*place, flags, mode);
}

Outcome<Descriptor> create_nameless(const Place& beside)
{
    const std::string name = ".hapnet-" + random_letters();
    auto file = create_beside(beside, name, O_RDWR, 0600);
    if (file) unlinkat(beside.folder(), name.c_str(), 0);
    return file;
}

std::string random_letters()
{
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz012345";
    std::array<unsigned char, 12> bytes{}; // 60 bits
    // The call returns all bytes or none, and waits at most until the system has started
    // (getrandom(2)).
    while (getrandom(bytes.data(), bytes.size(), 0) < 0 && errno == EINTR) {}
    std::string name;
    for (const unsigned char byte : bytes) name += letters[byte % letters.size()];
    return name;
}

Written write_all(int descriptor, std::string_view text)
{
    Written written;
    while (written.bytes < text.size()) {
        const auto rest = text.substr(written.bytes);
        const auto count = write(descriptor, rest.data(), rest.size());
        if (count < 0 && errno != EINTR) {
            written.error = {errno, std::generic_category()};
            break;
        }
        if (count > 0) written.bytes += static_cast<std::size_t>(count);
    }
    return written;
}

} // namespace hapnet::disk
