// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/text.hpp"
#include "proto/base/text.hpp"
#include "tests/property/emulator/core/profile/random_profile.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {
namespace {

TEST(ProfileText, EveryPrintedProfileReadsBackAsItself)
{
    RandomProfile random{1};
    for (int i = 0; i < 2'000; ++i) {
        const Profile profile = random.profile();
        const auto text = to_text(profile);
        const auto read = parse_profile(text, "printed", {});
        ASSERT_TRUE(read) << read.error().message << "\n" << text;
        ASSERT_TRUE(*read == profile) << text << "\nreads as\n" << to_text(*read);
    }
}

TEST(ProfileText, EveryPrintedRateAndSizeReadsBackAsItself)
{
    const auto stream = base::Seed{1}.stream("sizes");
    for (std::uint64_t i = 0; i < 5'000; ++i) {
        auto value = stream.bits(i) >> stream.below(40, i, 1);
        if (i % 2 == 0) value -= value % 1024;
        if (i % 3 == 0) value -= value % 1000;
        const auto rate = value % 1'000'000'000'001;
        const auto size = value % ((1ULL << 40) + 1);
        ASSERT_EQ(base::parse_bit_rate(base::bit_rate_text(rate)).value(), rate);
        ASSERT_EQ(base::parse_size(base::size_text(size)).value(), size);
    }
}

} // namespace
} // namespace hapnet::emulator
