// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A daemon with a device behind the fake libHD, and the state in which it leaves that device.
#include "tests/e2e/peer.hpp"
#include "tests/support/fake_hd/fake_hd.hpp"

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <gtest/gtest.h>
#include <sstream>
#include <thread>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

/// Returns the fake's log: whole lines only, as it may be writing.
std::vector<FakeHdCommand> frames_in(const std::string& file)
{
    std::istringstream lines{text_of(file)};
    std::vector<FakeHdCommand> frames;
    std::string line;
    while (std::getline(lines, line) && !lines.eof()) {
        std::istringstream words{line};
        int device = -1;
        FakeHdCommand frame{};
        words >> device >> frame.force_n[0] >> frame.force_n[1] >> frame.force_n[2] >>
            frame.motors_on;
        EXPECT_TRUE(words && device == 0) << line;
        frames.push_back(frame);
    }
    return frames;
}

double size_of(const FakeHdCommand& frame)
{
    return frame.motors_on ? std::hypot(frame.force_n[0], frame.force_n[1], frame.force_n[2]) : 0.0;
}

/// L's hand is the fake's, which stays where it is; R presses the cube against it.
class BehindLibHd : public ::testing::Test {
protected:
    BehindLibHd()
    {
        ::setenv(fake_hd_log_variable, log_.c_str(), 1);
        left_.emplace(1, here_, there_,
                      std::vector<std::string>{"--untested-device", "--device", "hdapi",
                                               "--hd-library", HAPNET_FAKE_HD, "--mount-offset",
                                               "-26mm,0mm,0mm", "--task", "T3"});
        ::unsetenv(fake_hd_log_variable);
        right_.emplace(2, there_, here_, std::vector<std::string>{"--task", "T3"});
    }

    void wait_for_a_push()
    {
        for (int i = 0; i < 1000; ++i) {
            const auto frames = frames_in(log_);
            if (!frames.empty() && size_of(frames.back()) > 0.2) return;
            std::this_thread::sleep_for(20ms);
        }
        FAIL() << "never pushed: " << left_->process().err();
    }

    /// Returns its last frames, once this signal has ended it.
    [[nodiscard]] std::vector<FakeHdCommand> last_after(int signal, int exit)
    {
        left_->process().signal(signal);
        EXPECT_EQ(left_->process().wait_exit(5s), exit) << left_->process().err();
        auto frames = frames_in(log_);
        EXPECT_GE(frames.size(), 3U);
        return {frames.end() - 3, frames.end()};
    }

    TemporaryFolder folder_;
    std::string log_ = folder_.file("frames");
    std::string here_ = free_place();
    std::string there_ = free_place();
    std::optional<Peer> left_;
    std::optional<Peer> right_;
};

} // namespace

TEST_F(BehindLibHd, LeavesTheMotorsOffWhenItIsToldToEndInTheMiddleOfAPush)
{
    ASSERT_NO_FATAL_FAILURE(wait_for_a_push());
    for (const FakeHdCommand& frame : last_after(SIGTERM, 0)) {
        EXPECT_EQ(size_of(frame), 0.0);
        EXPECT_FALSE(frame.motors_on);
    }
    right_->stop();
}

TEST_F(BehindLibHd, LeavesTheMotorsOffWhenItDiesInTheMiddleOfAPush)
{
    ASSERT_NO_FATAL_FAILURE(wait_for_a_push());
    const FakeHdCommand last = last_after(SIGABRT, 128 + SIGABRT).back();
    EXPECT_EQ(size_of(last), 0.0);
    EXPECT_FALSE(last.motors_on);
    right_->stop();
}

} // namespace hapnet::e2e
