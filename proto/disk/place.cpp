// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/disk/place.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <fcntl.h>
#include <linux/magic.h>
#include <sys/vfs.h>
#include <utility>

namespace hapnet::disk {

namespace {

/// These messages say what to do, so no cure is added to them.
class RefusalCategory : public std::error_category {
public:
    [[nodiscard]] const char* name() const noexcept override { return "shared folder"; }
    [[nodiscard]] std::string message(int value) const override
    {
        switch (static_cast<Refusal>(value)) {
        case Refusal::link_of_another_user:
            return "a symbolic link on the way there belongs to another user: write the path that "
                   "it leads to, or choose another";
        case Refusal::file_of_another_user:
            return "this belongs to another user: choose another path, or have it removed";
        case Refusal::file_with_several_names:
            return "this file has another name (a hard link), whose content would change, too: "
                   "remove this name, or choose another path";
        }
        return "refused";
    }
    [[nodiscard]] std::error_condition
    default_error_condition(int /*value*/) const noexcept override
    {
        return std::errc::permission_denied;
    }
};

/// The number of links that the kernel follows (path_resolution(7)).
constexpr int links_max = 40;

tl::unexpected<std::error_code> refused(int error)
{
    return tl::unexpected{std::error_code{error, std::generic_category()}};
}

/// Removes the first name from a relative path and returns it.
std::string take_name(std::string& path)
{
    const auto end = std::min(path.find('/'), path.size());
    std::string name = path.substr(0, end);
    path.erase(0, path.find_first_not_of('/', end));
    return name;
}

/// Opens the folder in which a path begins. The path becomes relative to it.
Descriptor beginning_of(std::string& path)
{
    const char* start = path.starts_with('/') ? "/" : ".";
    path.erase(0, path.find_first_not_of('/'));
    return Descriptor{open(start, O_PATH | O_DIRECTORY | O_CLOEXEC)};
}

bool is_this_user_or_root(uid_t owner) { return owner == geteuid() || owner == 0; }

/// True if `owner`, the owner of a file or a link in the folder, may decide where this user writes.
bool is_trusted(uid_t owner, int folder)
{
    struct stat of_folder {};
    return is_this_user_or_root(owner) ||
           (fstat(folder, &of_folder) == 0 && owner == of_folder.st_uid);
}

/// Returns the target of a link; "" with the reason in errno.
std::string target_of(int folder, const std::string& name)
{
    std::array<char, PATH_MAX> text{};
    const auto length = readlinkat(folder, name.c_str(), text.data(), text.size());
    return {text.data(), static_cast<std::size_t>(std::max<ssize_t>(length, 0))};
}

/// True for a folder of /proc. Some of its links lead to files without a path.
bool is_of_kernel(int folder)
{
    struct statfs of_folder {};
    return fstatfs(folder, &of_folder) == 0 && of_folder.f_type == PROC_SUPER_MAGIC;
}

} // namespace

std::error_code error_of(Refusal refusal)
{
    static const RefusalCategory category;
    return {static_cast<int>(refusal), category};
}

Outcome<Place> Place::find(std::string path, LastLink last_link)
{
    if (path.empty()) return refused(ENOENT);
    if (path.ends_with('/')) return refused(EISDIR);
    Descriptor folder = beginning_of(path);
    for (int links = 0; folder.is_open();) {
        const std::string name = take_name(path);
        const bool is_last = path.empty();
        if (name.empty()) return refused(EISDIR); // the link leads to /
        struct stat found {};
        const bool is_there =
            fstatat(folder.number(), name.c_str(), &found, AT_SYMLINK_NOFOLLOW) == 0;
        if (!is_there && (errno != ENOENT || !is_last)) return refused(errno);
        const bool is_followed =
            is_there && S_ISLNK(found.st_mode) && !(is_last && last_link == LastLink::kept);
        if (is_followed) {
            if (++links > links_max) return refused(ELOOP);
            if (!is_trusted(found.st_uid, folder.number()))
                return tl::unexpected{error_of(Refusal::link_of_another_user)};
            const std::string target = target_of(folder.number(), name);
            if (target.empty()) return refused(errno);
            if (is_last && !target.starts_with('/') && is_of_kernel(folder.number())) {
                if (fstatat(folder.number(), name.c_str(), &found, 0) != 0) return refused(errno);
                Place place{std::move(folder), name};
                place.found_ = found;
                place.is_open_file_ = true;
                return place;
            }
            path = is_last ? target : target + '/' + path;
            if (target.starts_with('/')) folder = beginning_of(path);
            continue;
        }
        if (is_last) {
            Place place{std::move(folder), name};
            if (is_there) place.found_ = found;
            return place;
        }
        constexpr int flags = O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
        folder = Descriptor{openat(folder.number(), name.c_str(), flags)};
    }
    return refused(errno);
}

std::error_code Place::why_not_written_to(mode_t mode) const
{
    if (!found_ || is_open_file_) return {};
    if (S_ISDIR(found_->st_mode)) return {EISDIR, std::generic_category()};
    // Only root can create devices, whoever owns them.
    if (!is_regular() && !is_pipe()) return {};
    const uid_t owner = found_->st_uid;
    const bool is_secret = (mode & (S_IRWXG | S_IRWXO)) == 0;
    if (!(is_secret ? is_this_user_or_root(owner) : is_trusted(owner, folder())))
        return error_of(Refusal::file_of_another_user);
    if (is_regular() && found_->st_nlink > 1) return error_of(Refusal::file_with_several_names);
    return {};
}

std::error_code Place::why_not_replaced() const
{
    if (!found_) return {};
    if (S_ISDIR(found_->st_mode)) return {EISDIR, std::generic_category()};
    struct stat of_folder {};
    if (fstat(folder(), &of_folder) != 0) return {errno, std::generic_category()};
    const uid_t user = geteuid();
    const bool is_sticky = (of_folder.st_mode & S_ISVTX) != 0 && user != 0;
    if (is_sticky && found_->st_uid != user && of_folder.st_uid != user)
        return error_of(Refusal::file_of_another_user);
    return {};
}

} // namespace hapnet::disk
