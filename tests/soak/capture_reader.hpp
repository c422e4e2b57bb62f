// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <thread>

namespace hapnet::soak {

/// A pipe in the file system that takes a capture and counts its packets, on a thread of its own:
/// ten minutes would fill 5 GB of a disk.
class CaptureReader {
public:
    /// Throws std::system_error when there can be no pipe at `path`.
    explicit CaptureReader(std::string path);
    ~CaptureReader();
    CaptureReader(const CaptureReader&) = delete;
    CaptureReader& operator=(const CaptureReader&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }

    /// Returns the packets of the whole capture, once its writer has ended.
    [[nodiscard]] std::uint64_t packets();

private:
    void read_all();
    void end();

    std::string path_;
    std::uint64_t packets_ = 0;
    std::thread thread_;
};

} // namespace hapnet::soak
