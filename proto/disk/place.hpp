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

/// A value, or why the system or this folder's rules refuse it.
template <typename Value>
using Outcome = tl::expected<Value, std::error_code>;

/// Rules against other users of the machine, who can put files and links into a shared folder such
/// as /tmp: which existing files may be written to, and which links are followed.
enum class Refusal : std::uint8_t {
    link_of_another_user = 1,
    file_of_another_user,
    file_with_several_names,
};
[[nodiscard]] std::error_code error_of(Refusal refusal);

/// The place where a file is or is going to be: an open folder, and a name in it. Later changes to
/// the path by other programs have no effect.
class Place {
public:
    enum class LastLink : std::uint8_t { followed, kept };

    /// Walks along a path. A symbolic link is followed when it belongs to this user, to root, or to
    /// the owner of the folder that it is in, as the kernel does in folders with the sticky bit
    /// (fs.protected_symlinks); otherwise the place is refused. `kept`: the name at the end stays,
    /// even if it is that of a link.
    [[nodiscard]] static Outcome<Place> find(std::string path,
                                             LastLink last_link = LastLink::followed);

    [[nodiscard]] int folder() const { return folder_.number(); }
    [[nodiscard]] const std::string& name() const { return name_; }
    /// The status of what is there; nullopt: nothing is.
    [[nodiscard]] const std::optional<struct stat>& found() const { return found_; }
    /// True for what a process has open and a link of the kernel leads to: the pipe behind
    /// /dev/stdout, say. It has no other name.
    [[nodiscard]] bool is_open_file() const { return is_open_file_; }
    [[nodiscard]] bool is_regular() const { return found_ && S_ISREG(found_->st_mode); }
    [[nodiscard]] bool is_pipe() const { return found_ && S_ISFIFO(found_->st_mode); }

    /// Why what is there must not be written to: it is a folder; or a file or a pipe that belongs
    /// neither to this user nor to root nor to the owner of the folder; or a file that has another
    /// name besides, which may be anywhere. No error: it may. `mode`: of the file that would be
    /// made there; what only its owner may read does not go to the owner of the folder either.
    [[nodiscard]] std::error_code why_not_written_to(mode_t mode) const;
    /// Why what is there cannot be replaced by a file of this user: it is a folder; or a file of
    /// another user where the folder has the sticky bit. No error: it can.
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
