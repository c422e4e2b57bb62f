// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/ping.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <string>

/// Output that can be read has a delay for each datagram that is not lost, and means the same with
/// the line ends of Windows. Errors name a line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    std::string text;
    std::string with_returns;
    for (const std::uint8_t byte : std::span{data, size}) {
        text += static_cast<char>(byte);
        if (byte == '\n') with_returns += '\r';
        with_returns += static_cast<char>(byte);
    }
    const auto read = emulator::tools::read_ping(text);
    const auto again = emulator::tools::read_ping(with_returns);
    base::ensure(read.has_value() == again.has_value());
    if (!read) {
        base::ensure(read.error().message.rfind("line ", 0) == 0);
        return 0;
    }
    base::ensure(read->round_trip && again->round_trip && !read->up && !read->down);
    const auto& way = *read->round_trip;
    base::ensure(way.delays.size() == way.lost.size() && !way.lost.empty());
    for (std::size_t i = 0; i < way.lost.size(); ++i) {
        base::ensure(way.delays[i].has_value() != way.lost[i]);
        base::ensure(!way.delays[i] || *way.delays[i] >= base::Duration{0});
    }
    base::ensure(!way.spacing || *way.spacing > base::Duration{0});
    base::ensure(way.delays == again->round_trip->delays);
    return 0;
}
