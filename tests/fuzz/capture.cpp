// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/captures.hpp"
#include "proto/base/ensure.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <algorithm>
#include <string>

namespace {

using namespace hapnet;

void ensure_whole(const std::optional<emulator::tools::MeasuredWay>& way)
{
    if (!way) return;
    base::ensure(way->delays.size() == way->lost.size());
    for (std::size_t i = 0; i < way->lost.size(); ++i) {
        base::ensure(!(way->lost[i] && way->delays[i]));
    }
    // The stream begins and ends with a datagram that arrived.
    base::ensure(!way->lost.empty() && !way->lost.front() && !way->lost.back());
}

} // namespace

/// Packets lie within the bytes. Measurements of them, as one capture and as both ends of a path,
/// are consistent. Errors name a packet.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    std::string bytes;
    for (const std::uint8_t byte : std::span{data, size}) bytes += static_cast<char>(byte);
    const auto capture = emulator::tools::read_capture(bytes);
    if (!capture) {
        base::ensure(capture.error().message.rfind("packet ", 0) == 0);
        return 0;
    }
    base::ensure(emulator::tools::is_capture(bytes));
    const auto all = std::as_bytes(std::span{bytes});
    for (const auto& packet : capture->packets) {
        base::ensure(packet.payload.empty() ||
                     (packet.payload.data() >= all.data() &&
                      packet.payload.data() + packet.payload.size() <= all.data() + all.size()));
        base::ensure(packet.payload.size() <= packet.payload_bytes);
    }
    for (const auto& measured : {emulator::tools::measure_capture(*capture),
                                 emulator::tools::measure_ends(*capture, *capture)}) {
        if (!measured) continue;
        ensure_whole(measured->round_trip);
        ensure_whole(measured->up);
        ensure_whole(measured->down);
    }
    return 0;
}
