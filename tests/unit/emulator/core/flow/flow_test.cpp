// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/flow/flow.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {
namespace {

TEST(Flow, HasANameThatKeysCanHave)
{
    for (const char* const name : {"a", "voice", "ssh-2", "0"}) {
        EXPECT_TRUE(validate_flow_name(name)) << name;
    }
    for (const char* const name : {"", "Voice", "a b", "a.b", "a_b", "rest", "up", "down", "both",
                                   "flow", "all", "abcdefghijklmnopqrstuvwxyz-0123456"}) {
        EXPECT_FALSE(validate_flow_name(name)) << name;
    }
}

} // namespace
} // namespace hapnet::emulator
