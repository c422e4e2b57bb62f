// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/frame.hpp"
#include "emulator/core/too_big.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

/// Any bytes are a frame of some kind. Fixed checksums are right: fixing them again changes
/// nothing, and the frame stays what it was. "Too big" answers get no answer.
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
    base::ensure(!emulator::says_port_unreachable(frame, bytes) ||
                 frame.kind == emulator::FrameKind::ip);
    if (frame.marks != base::IpMarks{}) {
        auto marked = fixed;
        emulator::mark_congestion(marked);
        base::ensure(emulator::read_frame(marked).marks == frame.marks.with_congestion());
        twice = marked;
        emulator::fix_checksums(twice);
        base::ensure(twice == marked); // its checksum was brought up to date
    }
    for (const std::size_t mtu : {std::size_t{68}, std::size_t{1280}}) {
        const auto answer = emulator::too_big_answer(bytes, mtu);
        if (answer.empty()) continue;
        base::ensure(answer.size() <= frame.header_bytes + mtu);
        twice = answer;
        emulator::fix_checksums(twice);
        base::ensure(twice == answer);
        twice.resize(twice.size() + mtu);
        base::ensure(emulator::too_big_answer(twice, mtu).empty());
    }
    return 0;
}
