// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/exit_guard.hpp"

#include "proto/net/crash_signal.hpp"

#include <cstdlib>
#include <gtest/gtest.h>
#include <poll.h>
#include <thread>
#include <tuple>
#include <unistd.h>

namespace hapnet::net::exit_guard_test {
namespace {

constexpr const char* said =
    "program under test: .* has called exit\\(\\) in the middle of the run";

TEST(ExitGuardDeathTest, TurnsACallOfExitIntoAFailureThatIsTold)
{
    const auto leave = [](auto how) {
        const ExitGuard guard{"program under test"};
        how(0);
    };
    EXPECT_EXIT(leave([](int code) { std::exit(code); }), testing::ExitedWithCode(1), said);
    EXPECT_EXIT(leave([](int code) { std::quick_exit(code); }), testing::ExitedWithCode(1), said);
}

TEST(ExitGuardDeathTest, LetsAProgramEndAfterItsRun)
{
    const auto run = [] { const ExitGuard guard{"program under test"}; };
    EXPECT_EXIT((run(), std::exit(5)), testing::ExitedWithCode(5), "");
}

/// The watchdog of a peer waits for the crash signal and ends the force.
TEST(ExitGuardDeathTest, HasTheForceEndedBeforeItSaysAnything)
{
    const auto leave = [] {
        const ExitGuard guard{"program under test"};
        const CrashSignal crash;
        std::thread watchdog{[&] {
            pollfd polled{crash.descriptor(), POLLIN, 0};
            std::ignore = poll(&polled, 1, -1);
            std::ignore = write(STDERR_FILENO, "zero force; ", 12);
            crash.acknowledge();
        }};
        std::exit(0);
    };
    EXPECT_EXIT(leave(), testing::ExitedWithCode(1), "zero force; program under test: .*exit");
}

} // namespace
} // namespace hapnet::net::exit_guard_test
