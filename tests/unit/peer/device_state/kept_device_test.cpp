// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/device_state/kept_device.hpp"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hapnet::peer::device_state {
namespace {

using namespace std::chrono_literals;

class Kept : public ::testing::Test {
protected:
    Kept() : folder_{testing::TempDir() + "hapnet-kept-" + std::to_string(getpid())}
    {
        std::filesystem::remove_all(folder_);
        ::setenv("XDG_STATE_HOME", folder_.c_str(), 1);
    }
    ~Kept() override
    {
        ::unsetenv("XDG_STATE_HOME");
        std::filesystem::remove_all(folder_);
    }

    [[nodiscard]] static KeptDevice open() { return {{.backend = "falcon", .serial = "1"}, ""}; }

    std::string folder_;
};

TEST_F(Kept, IsUntestedAndWarmUntilItIsKnownBetter)
{
    const KeptDevice kept = open();
    EXPECT_EQ(kept.path(), folder_ + "/hapnet/device/falcon-1.json");
    EXPECT_NE(kept.why_untested(), "");
    EXPECT_EQ(kept.heat_at_start(15s), unknown_heat);
    EXPECT_FALSE(std::filesystem::exists(kept.path()));
}

TEST_F(Kept, OutlivesTheProgramInAFileOfItsUserAlone)
{
    KeptDevice first = open();
    first.on_passed();
    first.on_rest(0.5);
    struct stat found {};
    ASSERT_EQ(stat(first.path().c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777U, 0600U);
    const KeptDevice second = open();
    EXPECT_EQ(second.why_untested(), "");
    EXPECT_LE(second.heat_at_start(15s), 0.5);
    EXPECT_GT(second.heat_at_start(1000000s), 0.49);
}

TEST_F(Kept, DoesNotKnowTheHeatOfADeviceWhoseProgramWasKilled)
{
    KeptDevice first = open();
    first.on_rest(0.0);
    first.on_use(); // and no more is heard of it
    EXPECT_EQ(open().heat_at_start(15s), unknown_heat);
}

TEST_F(Kept, DoesNotUseAFileThatItCannotRead)
{
    KeptDevice first = open();
    first.on_passed();
    std::ofstream{first.path()} << "{";
    testing::internal::CaptureStderr();
    const KeptDevice second = open();
    EXPECT_NE(testing::internal::GetCapturedStderr().find("falcon-1.json"), std::string::npos);
    EXPECT_NE(second.why_untested(), "");
}

TEST_F(Kept, SaysThatItCannotWriteAndGoesOn)
{
    std::ofstream{folder_} << "in the way of the folder";
    KeptDevice kept = open();
    testing::internal::CaptureStderr();
    kept.on_rest(0.0);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("cannot be kept"), std::string::npos);
}

} // namespace
} // namespace hapnet::peer::device_state
