// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/probe_message.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator::tools {
namespace {

using namespace std::chrono_literals;

ProbeMessage some_answer()
{
    return {.is_answer = true,
            .session = 0x0123456789abcdef,
            .sequence = 41,
            .sent = base::TimePoint{5s},
            .received = base::TimePoint{5s + 80ms},
            .answered = base::TimePoint{5s + 80ms + 7us},
            .heard = 40,
            .boot = 99};
}

std::vector<std::byte> encoded(const ProbeMessage& message, std::size_t size)
{
    std::vector<std::byte> bytes(size, std::byte{0xaa});
    encode(message, bytes);
    return bytes;
}

TEST(ProbeMessage, ComesBackAsItWasWrittenAtEverySize)
{
    for (const std::size_t size : {ProbeMessage::bytes_min, std::size_t{144}, std::size_t{1400}}) {
        EXPECT_EQ(decode_probe(encoded(some_answer(), size)), some_answer()) << size;
    }
}

TEST(ProbeMessage, IsRefusedWhenAnyOfItsBytesWasChangedOrItWasCutOff)
{
    const auto whole = encoded(some_answer(), 100);
    for (std::size_t i = 0; i < whole.size(); ++i) {
        auto changed = whole;
        changed[i] ^= std::byte{0x10};
        EXPECT_FALSE(decode_probe(changed)) << i;
        EXPECT_FALSE(decode_probe(std::span{whole}.first(i))) << i;
    }
}

TEST(ProbeMessage, KnowsNoBootWhereTheSystemTellsNone)
{
    EXPECT_EQ(boot_number(""), 0U);
    EXPECT_NE(boot_number("0e1b"), boot_number("0e1c"));
}

} // namespace
} // namespace hapnet::emulator::tools
