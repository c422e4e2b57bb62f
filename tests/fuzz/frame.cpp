// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/frame.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

/// Any bytes are a frame of some kind. Fixed checksums are right: fixing them again changes
/// nothing, and the frame stays what it was.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    const auto bytes = fuzz::bytes_of(data, size);
    const auto frame = emulator::read_frame(bytes);
    base::ensure(frame.header_bytes <= size);
    std::vector<std::byte> fixed(bytes.begin(), bytes.end());
    emulator::fix_checksums(fixed);
    auto twice = fixed;
    emulator::fix_checksums(twice);
    base::ensure(twice == fixed);
    const auto again = emulator::read_frame(fixed);
    base::ensure(again.kind == frame.kind && again.header_bytes == frame.header_bytes);
    std::ignore = emulator::flow_of(bytes);
    if (frame.marks != base::IpMarks{}) {
        auto marked = fixed;
        emulator::mark_congestion(marked);
        base::ensure(emulator::read_frame(marked).marks == frame.marks.with_congestion());
        twice = marked;
        emulator::fix_checksums(twice);
        base::ensure(twice == marked); // its checksum was brought up to date
    }
    return 0;
}
