// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/disk/private_file.hpp"

#include "proto/disk/descriptor.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

namespace hapnet::disk {

namespace {

/// The access to a file by users other than its owner, this user and root: none, by its mode, or by
/// its access control list.
enum class Others : std::uint8_t { none, by_mode, by_list };

/// An entry of an access control list in the kernel's encoding (linux/posix_acl_xattr.h). Numbers
/// are little-endian.
struct AclEntry {
    std::uint32_t tag = 0;
    std::uint32_t permissions = 0;
    std::uint32_t id = 0;
};

constexpr std::uint32_t acl_version = 2;
constexpr std::uint32_t owner_tag = 0x01, user_tag = 0x02, mask_tag = 0x10, other_tag = 0x20;
constexpr std::size_t version_bytes = 4, entry_bytes = 8;

std::uint32_t number_in(std::span<const unsigned char> bytes)
{
    std::uint32_t number = 0;
    for (std::size_t i = bytes.size(); i > 0; --i) number = number << 8U | bytes[i - 1];
    return number;
}

AclEntry entry_in(std::span<const unsigned char> bytes)
{
    return {number_in(bytes.first(2)), number_in(bytes.subspan(2, 2)), number_in(bytes.last(4))};
}

/// True if the list gives any access to another user or to a group. Its length must be that of
/// whole entries.
bool gives_to_others(std::span<const unsigned char> entries)
{
    std::uint32_t mask = 7; // limits all entries but those of the owner and `other`
    for (auto rest = entries; !rest.empty(); rest = rest.subspan(entry_bytes)) {
        const AclEntry entry = entry_in(rest.first(entry_bytes));
        if (entry.tag == mask_tag) mask = entry.permissions;
    }
    for (auto rest = entries; !rest.empty(); rest = rest.subspan(entry_bytes)) {
        const AclEntry entry = entry_in(rest.first(entry_bytes));
        if (entry.tag == owner_tag || entry.tag == mask_tag) continue;
        if (entry.tag == user_tag && (entry.id == geteuid() || entry.id == 0)) continue;
        const auto given = entry.tag == other_tag ? entry.permissions : entry.permissions & mask;
        if (given != 0) return true;
    }
    return false;
}

/// Determines the access of other users. If there is an access control list, the group bits of the
/// mode are its mask.
Others others_of(int descriptor, const struct stat& status)
{
    std::array<unsigned char, version_bytes + 512 * entry_bytes> list{};
    const auto size = fgetxattr(descriptor, "system.posix_acl_access", list.data(), list.size());
    if (size < 0 && (errno == ENODATA || errno == EOPNOTSUPP))
        return (status.st_mode & 077U) != 0 ? Others::by_mode : Others::none;
    const auto bytes = static_cast<std::size_t>(size < 0 ? 0 : size);
    if (bytes < version_bytes || (bytes - version_bytes) % entry_bytes != 0) return Others::by_list;
    const std::span all = std::span{list}.first(bytes);
    if (number_in(all.first(version_bytes)) != acl_version) return Others::by_list;
    return gives_to_others(all.subspan(version_bytes)) ? Others::by_list : Others::none;
}

/// Returns the reason why a file is not private; "": it is private.
std::string complaint(const Descriptor& file, const struct stat& status, const std::string& path,
                      const PrivateKind& kind)
{
    if (!S_ISREG(status.st_mode)) return fmt::format("{}: a {} is a regular file", path, kind.name);
    if (status.st_uid != geteuid() && status.st_uid != 0) {
        return fmt::format("{}: this {} belongs to another user; run: chown \"$(id -u)\" {}", path,
                           kind.name, path);
    }
    switch (others_of(file.number(), status)) {
    case Others::none: break;
    case Others::by_mode:
        return fmt::format("{}: others may use this {}; run: chmod 600 {}", path, kind.name, path);
    case Others::by_list:
        return fmt::format("{0}: others may use this {1}, by its access control list; run: setfacl "
                           "--remove-all {0} && chmod 600 {0}",
                           path, kind.name);
    }
    if (status.st_size > static_cast<off_t>(kind.bytes_max))
        return fmt::format("{}: larger than {} KiB", path, kind.bytes_max >> 10U);
    return {};
}

} // namespace

base::Result<std::string> read_private(const std::string& path, const PrivateKind& kind)
{
    const auto refuse = [&path](std::string_view why) {
        return base::fail(fmt::format("cannot read {}: {}", path, why));
    };
    const int follow = kind.links == PrivateKind::Links::followed ? 0 : O_NOFOLLOW;
    const Descriptor file{open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | follow)};
    if (!file.is_open()) {
        return refuse(errno == ELOOP && follow != 0 ? "it is a symbolic link; name the file itself"
                                                    : std::strerror(errno));
    }
    struct stat status {};
    if (fstat(file.number(), &status) != 0) return refuse(std::strerror(errno));
    if (std::string why = complaint(file, status, path, kind); !why.empty())
        return base::fail(std::move(why));
    // The text is allocated once, because growing would leave the secret in freed memory.
    std::string text(static_cast<std::size_t>(status.st_size), '\0');
    std::size_t size = 0;
    while (size < text.size()) {
        const ssize_t got = read(file.number(), text.data() + size, text.size() - size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return refuse(std::strerror(errno));
        if (got == 0) break;
        size += static_cast<std::size_t>(got);
    }
    text.resize(size);
    return text;
}

} // namespace hapnet::disk
