// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"

#include <span>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace hapnet::fuzz {

/// A file that is in memory alone, for what reads files by their paths.
class MemoryFile {
public:
    explicit MemoryFile(std::span<const std::byte> bytes)
        : descriptor_{memfd_create("input", MFD_CLOEXEC)}
    {
        base::ensure(descriptor_ >= 0);
        base::ensure(::write(descriptor_, bytes.data(), bytes.size()) ==
                     static_cast<ssize_t>(bytes.size()));
    }
    ~MemoryFile() { close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    [[nodiscard]] std::string path() const
    {
        return "/proc/self/fd/" + std::to_string(descriptor_);
    }

private:
    int descriptor_;
};

} // namespace hapnet::fuzz
