// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <sys/types.h>

namespace hapnet::disk {

/// A file that appears whole or not at all: it is written beside its place under a temporary
/// name, which is taken at construction, so that a place that cannot be written is found before
/// the run and not after it. A symbolic link is followed; what is there and is no regular file (a
/// device, a pipe) is never replaced but written to.
///
/// The temporary name is FILE.PID.partial. A process that is killed leaves it behind, with what it
/// had written; the next one that writes FILE removes it.
class ResultFile {
public:
    /// Throws std::system_error naming the file, and the option that asked for it, if one did.
    /// `mode`: of a new file.
    explicit ResultFile(std::string path, std::string_view option = "", unsigned mode = 0644);
    /// Removes what was not committed.
    ~ResultFile();
    ResultFile(const ResultFile&) = delete;
    ResultFile& operator=(const ResultFile&) = delete;

    /// Writes text that the file goes on with. Throws std::system_error; then none of it is
    /// written.
    void append(std::string_view text);

    /// Moves what was written to its place, after append() has failed. Does nothing when that is
    /// not possible.
    void keep() noexcept;

    /// Writes the text that it ends with and moves the file to its place. Throws
    /// std::system_error.
    void commit(std::string_view text);

private:
    std::string path_;
    std::string temporary_; // empty: written in place
    off_t length_ = 0;
    int descriptor_ = -1;
};

} // namespace hapnet::disk
