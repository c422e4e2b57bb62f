// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/replay/replay.hpp"
#include "device/simulated/operator.hpp"
#include "proto/base/ensure.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <span>
#include <string>

/// An accepted path can be followed and stays in reach. An accepted operator prints as text that
/// reads back as the same operator. Errors are not empty.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    const auto trace = device::parse_hand_trace(text, "hand.csv");
    base::ensure(trace || !trace.error().message.empty());
    if (trace) {
        const std::string printed = device::print_hand_trace(*trace);
        base::ensure(device::parse_hand_trace(printed, "again.csv").value() == *trace);
        device::Replay hand{*trace, "hand.csv"};
        hand.on_cue({.start = {}, .hands_on = {}, .seed = base::Seed{0}});
        for (int i = 0; i < 100; ++i) {
            const auto sample = hand.read(base::TimePoint{std::chrono::milliseconds{10 * i}});
            base::ensure(base::norm(sample.hip - base::Position{}) <= 20.0);
            base::ensure(base::is_finite(sample.velocity));
        }
    }
    const auto open = [&](const std::string&) -> base::Result<std::string> { return text; };
    const auto person = device::load_operator("hand.toml", open);
    base::ensure(person || !person.error().message.empty());
    if (!person) return 0;
    text = device::print_operator(*person);
    base::ensure(device::load_operator("hand.toml", open).value() == *person);
    return 0;
}
