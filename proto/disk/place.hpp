// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/disk/descriptor.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <tl/expected.hpp>

namespace hapnet::disk {

/// A value, or the reason why the system or the rules of Refusal deny it.
template <typename Value>
using Outcome = tl::expected<Value, std::error_code>;

/// The reasons for refusing a file or a link. They guard against other users of the machine, who
/// can put files and links into a shared folder such as /tmp.
enum class Refusal : std::uint8_t {
    link_of_another_user = 1,
    file_of_another_user,
    file_with_several_names,
};
[[nodiscard]] std::error_code error_of(Refusal refusal);

/// The place of a file that exists or is to be created: an open folder, and a name in it. Later
/// changes to the path by other programs have no effect.
class Place {
public:
    enum class LastLink : std::uint8_t { followed, kept };

    /// Resolves a path. A symbolic link is followed if it belongs to this user, to root, or to the
    /// owner of its folder, as the kernel does in folders with the sticky bit
    /// (fs.protected_symlinks). Otherwise the place is refused. With LastLink::kept, a link at the
    /// end of the path is not followed.
    [[nodiscard]] static Outcome<Place> find(std::string path,
                                             LastLink last_link = LastLink::followed);

    [[nodiscard]] int folder() const { return folder_.number(); }
    [[nodiscard]] const std::string& name() const { return name_; }
    /// Returns the status of the existing file; nullopt if there is none.
    [[nodiscard]] const std::optional<struct stat>& found() const { return found_; }
    /// True if the path leads, by a link of the kernel, to a file that a process has open, such as
    /// the pipe behind /dev/stdout. Such a file has no other name.
    [[nodiscard]] bool is_open_file() const { return is_open_file_; }
    [[nodiscard]] bool is_regular() const { return found_ && S_ISREG(found_->st_mode); }
    [[nodiscard]] bool is_pipe() const { return found_ && S_ISFIFO(found_->st_mode); }

    /// Returns why the existing file must not be written to, or no error. A folder must not. A
    /// regular file or a pipe must belong to this user, to root or to the owner of its folder. A
    /// regular file must have no second name, which could be anywhere. `mode` is that of the file
    /// that would be created: if only its owner may read it, the owner of the folder is not trusted
    /// either.
    [[nodiscard]] std::error_code why_not_written_to(mode_t mode) const;
    /// Returns why a file of this user cannot replace the existing file, or no error. A folder
    /// cannot be replaced, nor can a file of another user in a folder with the sticky bit.
    [[nodiscard]] std::error_code why_not_replaced() const;

private:
    Place(Descriptor folder, std::string name) : folder_{std::move(folder)}, name_{std::move(name)}
    {}

    Descriptor folder_;
    std::string name_;
    std::optional<struct stat> found_;
    bool is_open_file_ = false;
};

} // namespace hapnet::disk
