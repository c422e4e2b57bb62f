// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/clock.hpp"
#include "proto/net/stop_signal.hpp"
#include "proto/net/wait.hpp"

#include <array>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sched.h>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <tuple>
#include <unistd.h>

namespace hapnet::net {
namespace {

using namespace std::chrono_literals;

TEST(Clock, NeverRunsBackwards)
{
    auto last = monotonic_now();
    for (int i = 0; i < 10'000; ++i) {
        const auto now = monotonic_now();
        ASSERT_GE(now, last);
        last = now;
    }
}

TEST(Clock, GoesOnWhileTheMachineIsSuspended)
{
    // In a time namespace in which the machine was suspended for 1000 s.
    const pid_t outer = fork();
    if (outer == 0) {
        if (unshare(CLONE_NEWTIME) != 0) _exit(77);
        std::ofstream offsets{"/proc/self/timens_offsets"};
        offsets << "boottime 1000 0\n" << std::flush;
        if (!offsets) _exit(77);
        const auto before = monotonic_now();
        const pid_t inner = fork();
        if (inner == 0) {
            const auto later = monotonic_now();
            const bool is_later = later - before >= 1000s && later - before < 1100s;
            sleep_until(later + 1ms);
            const bool has_slept = monotonic_now() - later >= 1ms;
            _exit(is_later && has_slept && monotonic_now() - later < 100s ? 0 : 1);
        }
        int status = -1;
        waitpid(inner, &status, 0);
        _exit(WEXITSTATUS(status));
    }
    int status = -1;
    waitpid(outer, &status, 0);
    if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "needs to be root, to set a clock of its own";
    EXPECT_EQ(status, 0);
}

TEST(Clock, SleepingUntilAPastMomentReturnsAtOnce)
{
    sleep_until(base::TimePoint{});
    sleep_until(monotonic_now() - 1ns);
}

TEST(Clock, CountsFromADateThatHostsHaveInCommonWhereItIsAsked)
{
    EXPECT_LT(monotonic_now().time_since_epoch() - since_boot(), 1s);
    // In a program of its own, as the count stays.
    EXPECT_EXIT(
        {
            count_from_common_date();
            const auto since_1970 = std::chrono::nanoseconds{wall_clock_nanoseconds()};
            const auto apart =
                since_1970 % std::chrono::seconds{1 << 28} - monotonic_now().time_since_epoch();
            const auto before = monotonic_now();
            sleep_until(before + 1ms);
            const bool sleeps = monotonic_now() >= before + 1ms && monotonic_now() < before + 1h;
            const auto stamps =
                monotonic_minus_real() + since_1970 - monotonic_now().time_since_epoch();
            const bool fits_stamps = std::chrono::abs(stamps) < 10s;
            std::_Exit(std::chrono::abs(apart) < 10s && sleeps && fits_stamps ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
}

TEST(Clock, OneBootHasOneIdentity)
{
    EXPECT_EQ(boot_id(), boot_id());
    EXPECT_EQ(boot_id().size(), 36U);
}

TEST(Clock, UnpredictableBitsDiffer) { EXPECT_NE(unpredictable_bits(), unpredictable_bits()); }

TEST(Wait, EndsAtItsDeadlineAndNotBeforeIt)
{
    const auto deadline = monotonic_now() + 1ms;
    wait_readable({}, deadline);
    EXPECT_GE(monotonic_now(), deadline);
}

TEST(Wait, EndsAtOnceWhenTheDeadlineHasPassed)
{
    wait_readable({}, base::TimePoint{});
    wait_readable({}, monotonic_now() - 1h);
}

TEST(StopSignal, TurnsASignalIntoSomethingToRead)
{
    StopSignal stop;
    EXPECT_FALSE(stop.requested());
    ASSERT_EQ(raise(SIGTERM), 0);
    wait_readable(std::array{stop.descriptor()}, std::nullopt);
    EXPECT_TRUE(stop.requested());
    EXPECT_TRUE(stop.requested()); // stays true
    EXPECT_FALSE(stop.reload_requested());
}

TEST(StopSignal, TakesAHangupForAStopUnlessItMeansReload)
{
    {
        StopSignal stop;
        ASSERT_EQ(raise(SIGHUP), 0);
        EXPECT_TRUE(stop.requested());
    }
    StopSignal stop{Hangup::reload};
    ASSERT_EQ(raise(SIGHUP), 0);
    EXPECT_FALSE(stop.requested());
    EXPECT_TRUE(stop.reload_requested());
    EXPECT_FALSE(stop.reload_requested()); // consumed
}

TEST(StopSignal, IsSeenByWhoeverAsksAndAskedForFromAnywhere)
{
    const StopSignal stop;
    EXPECT_EQ(stop.requested_for(), base::Duration{0});
    std::thread{[&stop] { stop.request(); }}.join();
    EXPECT_TRUE(stop.requested());
    EXPECT_GT(stop.requested_for(), base::Duration{0});
}

/// Returns the end of a child that a signal, or its terminal, asks to end while it is stuck.
template <typename Stop>
int end_of_a_stuck_child(Stop ask)
{
    std::array<int, 2> started{};
    if (pipe(started.data()) != 0) return -1;
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    grantpt(terminal);
    unlockpt(terminal);
    const std::string name = ptsname(terminal);
    const pid_t child = fork();
    if (child == 0) {
        dup2(open(name.c_str(), O_RDWR | O_NOCTTY), STDIN_FILENO);
        close(terminal);
        const StopSignal stop;
        stop.enforce(10ms, 33);
        std::ignore = write(started[1], "!", 1);
        while (true) pause();
    }
    char byte = 0;
    std::ignore = read(started[0], &byte, 1);
    ask(child, terminal);
    int status = -1;
    waitpid(child, &status, 0);
    close(started[0]);
    close(started[1]);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(StopSignal, EndsAProcessThatIsStuck)
{
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        EXPECT_EQ(end_of_a_stuck_child([&](pid_t child, int /*terminal*/) { kill(child, signal); }),
                  33);
    }
}

TEST(StopSignal, ComesFromATerminalThatGoesAway)
{
    EXPECT_EQ(end_of_a_stuck_child([](pid_t /*child*/, int terminal) { close(terminal); }), 33);
}

} // namespace
} // namespace hapnet::net
