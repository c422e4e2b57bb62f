// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/soak/capture_reader.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace hapnet::soak {

namespace {

/// A block of pcapng begins with its type and its length, in the order of this machine.
struct BlockHead {
    std::uint32_t type = 0;
    std::uint32_t bytes = 0;
};
constexpr std::uint32_t enhanced_packet = 6;

} // namespace

CaptureReader::CaptureReader(std::string path) : path_{std::move(path)}
{
    if (mkfifo(path_.c_str(), 0600) != 0) {
        throw std::system_error{errno, std::generic_category(), path_};
    }
    thread_ = std::thread{[this] { read_all(); }};
}

CaptureReader::~CaptureReader() { end(); }

std::uint64_t CaptureReader::packets()
{
    end();
    return packets_;
}

void CaptureReader::read_all()
{
    const int pipe = open(path_.c_str(), O_RDONLY | O_CLOEXEC); // returns when a writer opens it
    std::vector<char> part(1 << 16);
    std::array<char, sizeof(BlockHead)> head{};
    std::size_t head_bytes = 0; // that are there
    std::size_t to_skip = 0;    // of the block
    for (;;) {
        const auto count = read(pipe, part.data(), part.size());
        if (count <= 0) break;
        for (std::size_t at = 0; at < static_cast<std::size_t>(count);) {
            const auto left = static_cast<std::size_t>(count) - at;
            if (to_skip > 0) {
                const auto skipped = std::min(to_skip, left);
                to_skip -= skipped;
                at += skipped;
                continue;
            }
            head[head_bytes++] = part[at++];
            if (head_bytes < head.size()) continue;
            BlockHead block;
            std::memcpy(&block, head.data(), head.size());
            if (block.type == enhanced_packet) ++packets_;
            to_skip = block.bytes - head.size();
            head_bytes = 0;
        }
    }
    close(pipe);
}

/// A reader without any writer would wait for ever.
void CaptureReader::end()
{
    if (!thread_.joinable()) return;
    const int nobody = open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    if (nobody >= 0) close(nobody);
    thread_.join();
}

} // namespace hapnet::soak
