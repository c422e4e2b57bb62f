// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/disk/place.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>

namespace hapnet::disk {

/// A file that appears either complete or not at all. It is written under a temporary name in the
/// same folder. The constructor creates the temporary file, so that an unwritable place is found
/// before the run and not after it. An existing file that is not regular (a device, a pipe) is
/// written to and never replaced. Place says which symbolic links are followed and which pipes are
/// written to. A file of another user is not written to: a new file takes its name.
///
/// The temporary name is FILE.PID.LETTERS.partial. A process that is killed leaves this file
/// behind, with the text that it had written. The next process that writes FILE removes it.
class ResultFile {
public:
    /// Throws std::system_error naming the file, and the option that asked for it, if there is one.
    /// `mode` is the mode of the file, reduced by the umask of the process.
    explicit ResultFile(std::string path, std::string_view option = "", unsigned mode = 0644);
    /// Removes the temporary file unless it was committed or kept.
    ~ResultFile();
    ResultFile(const ResultFile&) = delete;
    ResultFile& operator=(const ResultFile&) = delete;

    /// Appends text to the file. Throws std::system_error; then none of the text is written.
    void append(std::string_view text);

    /// Moves the written part to its place after append() has failed. Returns false if none of it
    /// is there.
    bool keep() noexcept;

    /// Writes the last text and moves the file to its place. Throws std::system_error.
    void commit(std::string_view text);

    /// Does the same as commit(), and returns once the whole file is on the disk. If the machine
    /// fails meanwhile, the disk has the old file or the new one.
    void commit_to_disk(std::string_view text);

private:
    void move();

    std::string path_;
    std::optional<Place> place_; // always set after construction
    std::string temporary_;      // name in the folder of the place; empty: no temporary file
    off_t length_ = 0;
    Descriptor file_;
};

} // namespace hapnet::disk
