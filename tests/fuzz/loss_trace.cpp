// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/pattern.hpp"
#include "emulator/core/loss/trace.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <string>

/// An accepted trace has datagrams, and printed as one row of digits it reads as the same trace. So
/// does a pattern. Errors are not empty.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    for (const auto& trace : {emulator::parse_loss_trace(text), emulator::parse_loss_table(text)}) {
        if (!trace) {
            base::ensure(!trace.error().message.empty());
            continue;
        }
        base::ensure(trace->size() > 0 && trace->losses() <= trace->size());
        std::string row;
        for (std::size_t i = 0; i < trace->size(); ++i) row += trace->is_lost(i) ? '1' : '0';
        base::ensure(emulator::parse_loss_trace(row).value() == *trace);
    }
    if (const auto pattern = emulator::parse_pattern(text)) {
        base::ensure(emulator::to_text(*pattern) == text);
    }
    return 0;
}
