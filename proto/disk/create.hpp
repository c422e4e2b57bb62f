// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/disk/place.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

namespace hapnet::disk {

// Every file that a program writes is opened here. `flags` are those of open(2) that say how it is
// written: O_WRONLY, O_RDWR, O_APPEND.

/// Makes a file that was not there. The error is EEXIST if anything is, a link included.
[[nodiscard]] Outcome<Descriptor> create(const Place& place, int flags, mode_t mode);
/// Makes a new file like create(), under another name in the folder of `place`.
[[nodiscard]] Outcome<Descriptor> create_beside(const Place& place, const std::string& name,
                                                int flags, mode_t mode);

/// Opens an existing file to write to it, or makes a file of that mode. Does not empty an existing
/// file. Refuses the files that Place::why_not_written_to() rejects.
[[nodiscard]] Outcome<Descriptor> open_to_write(const Place& place, int flags, mode_t mode);
[[nodiscard]] Outcome<Descriptor> open_to_write(const std::string& path, int flags, mode_t mode);

/// Makes a file beside a place that has no name and goes with its descriptor.
[[nodiscard]] Outcome<Descriptor> create_nameless(const Place& beside);

/// Letters that no other user can guess, for a name.
[[nodiscard]] std::string random_letters();

/// The part of a text that was written: all of it, unless there is an error.
struct Written {
    std::size_t bytes = 0;
    std::error_code error{};
};
[[nodiscard]] Written write_all(int descriptor, std::string_view text);

} // namespace hapnet::disk
