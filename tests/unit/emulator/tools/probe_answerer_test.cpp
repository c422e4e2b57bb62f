// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/probe_answerer.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::emulator::tools {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{100s};

ProbeMessage question(std::uint64_t session, std::uint64_t sequence)
{
    return {.session = session, .sequence = sequence, .sent = start};
}

std::uint64_t heard(ProbeAnswerer& answerer, std::uint64_t session, std::uint64_t sequence,
                    base::TimePoint at = start)
{
    const auto answer = answerer.answer(question(session, sequence), at);
    EXPECT_TRUE(answer);
    return answer ? answer->heard : 0;
}

TEST(ProbeAnswerer, CountsTheQuestionsOfASessionAndNoCopyOfThem)
{
    ProbeAnswerer answerer{1};
    EXPECT_EQ(heard(answerer, 7, 0), 1U);
    EXPECT_EQ(heard(answerer, 7, 3), 2U);
    EXPECT_EQ(heard(answerer, 7, 3), 2U);
    EXPECT_EQ(heard(answerer, 7, 1), 3U); // reordered
    EXPECT_EQ(heard(answerer, 7, 1), 3U);
    EXPECT_EQ(heard(answerer, 8, 5), 1U); // of another one
    EXPECT_EQ(heard(answerer, 7, 5000), 4U);
    EXPECT_EQ(heard(answerer, 7, 3), 4U); // too far behind to tell
    EXPECT_EQ(heard(answerer, 7, 4999), 5U);
}

TEST(ProbeAnswerer, ForgetsTheSessionThatHasBeenSilentLongest)
{
    ProbeAnswerer answerer{1};
    for (std::uint64_t i = 0; i < ProbeAnswerer::sessions_max; ++i) {
        EXPECT_EQ(heard(answerer, i, 0, start + std::chrono::seconds{i}), 1U);
    }
    EXPECT_EQ(heard(answerer, 0, 1, start + 1h), 2U);
    EXPECT_EQ(heard(answerer, 1000, 0, start + 1h), 1U); // takes the place of session 1
    EXPECT_EQ(heard(answerer, 0, 2, start + 1h), 3U);
    EXPECT_EQ(heard(answerer, 1, 1, start + 1h), 1U);
}

TEST(ProbeAnswerer, NeverAnswersAnAnswer)
{
    ProbeAnswerer answerer{1};
    const auto answer = answerer.answer(question(7, 0), start + 3ms);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->received, start + 3ms);
    EXPECT_EQ(answer->sent, start);
    EXPECT_EQ(answer->boot, 1U);
    EXPECT_FALSE(answerer.answer(*answer, start));
}

} // namespace
} // namespace hapnet::emulator::tools
