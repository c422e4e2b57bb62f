// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/version.hpp"

#include <gtest/gtest.h>

namespace hapnet::base {
namespace {

TEST(Version, ThePrintedLineNamesProgramVersionCommitAndCompiler)
{
    const std::string line = version_line("hapnet-peer");
    EXPECT_EQ(line.find("hapnet-peer " + std::string{version()}), 0U);
    EXPECT_NE(line.find(commit()), std::string::npos);
    EXPECT_NE(line.find(compiler()), std::string::npos);
}

} // namespace
} // namespace hapnet::base
