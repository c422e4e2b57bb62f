// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/disk/place.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

namespace hapnet::disk {

// Functions that open every file that a program writes. `flags` are those of open(2) for the kind
// of writing: O_WRONLY, O_RDWR, O_APPEND.

/// Creates a new file. The error is EEXIST if anything has that name, even a link.
[[nodiscard]] Outcome<Descriptor> create(const Place& place, int flags, mode_t mode);
/// Creates a new file like create(), with another name in the folder of `place`.
[[nodiscard]] Outcome<Descriptor> create_beside(const Place& place, const std::string& name,
                                                int flags, mode_t mode);

/// Opens an existing file for writing without emptying it, or creates a file with that mode.
/// Refuses the files that Place::why_not_written_to() rejects.
[[nodiscard]] Outcome<Descriptor> open_to_write(const Place& place, int flags, mode_t mode);
[[nodiscard]] Outcome<Descriptor> open_to_write(const std::string& path, int flags, mode_t mode);

/// Creates a file without a name, in the folder of a place. It vanishes when its descriptor is
/// closed.
[[nodiscard]] Outcome<Descriptor> create_nameless(const Place& beside);

/// Returns letters for a name that no other user can guess.
[[nodiscard]] std::string random_letters();

/// The number of bytes of a text that were written. It is the whole text unless there is an error.
struct Written {
    std::size_t bytes = 0;
    std::error_code error{};
};
[[nodiscard]] Written write_all(int descriptor, std::string_view text);

} // namespace hapnet::disk
