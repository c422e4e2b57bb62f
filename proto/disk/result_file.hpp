// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/disk/place.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>

namespace hapnet::disk {

/// A file that appears whole or not at all: it is written beside its place under a temporary name,
/// which is taken at construction, so that a place that cannot be written is found before the run
/// and not after it. An existing file that is not regular (a device, a pipe) is never replaced but
/// written to. Place says which symbolic links are followed and whose pipes are written to. A file
/// of another user is not written to: a new one takes its name.
///
/// The temporary name is FILE.PID.LETTERS.partial. A process that is killed leaves it behind, with
/// what it had written; the next one that writes FILE removes it.
class ResultFile {
public:
    /// Throws std::system_error naming the file, and the option that asked for it, if one did.
    /// `mode`: of the file, as far as the umask of the process lets it.
    explicit ResultFile(std::string path, std::string_view option = "", unsigned mode = 0644);
    /// Removes what was not committed.
    ~ResultFile();
    ResultFile(const ResultFile&) = delete;
    ResultFile& operator=(const ResultFile&) = delete;

    /// Writes text that the file goes on with. Throws std::system_error; then none of it is
    /// written.
    void append(std::string_view text);

    /// Moves what was written to its place, after append() has failed. False: there is nothing of
    /// it there.
    bool keep() noexcept;

    /// Writes the text that it ends with and moves the file to its place. Throws
    /// std::system_error.
    void commit(std::string_view text);

    /// Commits like commit(), and returns once the whole file is on the disk. If the machine fails
    /// meanwhile, it has the old file or the new one.
    void commit_to_disk(std::string_view text);

private:
    void move();

    std::string path_;
    std::optional<Place> place_; // always set after construction
    std::string temporary_;      // a name in the folder of the place; empty: written in place
    off_t length_ = 0;
    Descriptor file_;
};

} // namespace hapnet::disk
