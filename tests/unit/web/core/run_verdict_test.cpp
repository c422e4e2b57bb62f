// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/run_verdict.hpp"

#include <gtest/gtest.h>

namespace hapnet::web {
namespace {

TEST(RunVerdict, IsValidWhereAllProgramsSaySo)
{
    const auto verdict = verdict_of(3, {{"A", R"({"valid":true})"}, {"B", R"({"valid":true})"}});
    EXPECT_EQ(verdict.json().dump(), R"({"run":3,"valid":true,"invalid_because":[]})");
    EXPECT_EQ(verdict.text(), "run 3 has ended: valid");
}

TEST(RunVerdict, NamesTheProgramAndItsReasons)
{
    const auto verdict = verdict_of(
        1, {{"A", R"({"valid":false,"invalid_because":["ticks were late","many were missed"]})"},
            {"B", R"({"valid":true})"},
            {"the emulator", R"({"valid":false})"}});
    EXPECT_EQ(verdict.because,
              (std::vector<std::string>{"A: ticks were late", "A: many were missed",
                                        "the emulator: it does not say why"}));
    EXPECT_EQ(verdict.text(), "run 1 has ended: not valid: A: ticks were late; A: many were "
                              "missed; the emulator: it does not say why");
}

TEST(RunVerdict, IsNotValidWithoutTheStatisticsOfAProgram)
{
    for (const char* text : {"", "{", "[]", "{}", "null"}) {
        EXPECT_EQ(verdict_of(1, {{"B", text}}).because,
                  (std::vector<std::string>{"B: it wrote no statistics"}))
            << text;
    }
}

} // namespace
} // namespace hapnet::web
