// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/stop_signal.hpp"

#include <array>
#include <cstdlib>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace hapnet::net::stop_signal_test {
namespace {

constexpr int patience_ms = 10'000;

/// A pipe, made like that of a program that starts another program.
struct Lifeline {
    Lifeline() { EXPECT_EQ(pipe(ends.data()), 0); }
    ~Lifeline()
    {
        for (const int end : ends) {
            if (end >= 0) close(end);
        }
    }
    Lifeline(const Lifeline&) = delete;
    Lifeline& operator=(const Lifeline&) = delete;
    void hang_up()
    {
        close(ends[1]);
        ends[1] = -1;
    }

    std::array<int, 2> ends{-1, -1};
};

/// Starts a process with this lifeline, as a program has it, and runs `work`, whose result is its
/// exit code. Returns once the process holds the lifeline.
template <typename Work>
pid_t start(Lifeline& lifeline, Work work)
{
    std::array<int, 2> ready{};
    EXPECT_EQ(pipe(ready.data()), 0);
    const pid_t child = fork();
    if (child == 0) {
        if (lifeline.ends[1] >= 0) close(lifeline.ends[1]);
        setenv(lifeline_variable, std::to_string(lifeline.ends[0]).c_str(), 1);
        const StopSignal stop;
        _exit(write(ready[1], "r", 1) == 1 ? work(stop) : 9);
    }
    close(ready[1]);
    char word = 0;
    EXPECT_EQ(read(ready[0], &word, 1), 1);
    close(ready[0]);
    return child;
}

int exit_code_of(pid_t process)
{
    int status = 0;
    waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int stops(const StopSignal& stop)
{
    pollfd polled{stop.descriptor(), POLLIN, 0};
    if (poll(&polled, 1, patience_ms) != 1) return 1;
    if (!stop.requested()) return 2;
    if (stop.number() != SIGTERM) return 3;
    return stop.came_to_group() ? 4 : 0;
}

TEST(StopSignal, ComesWhenTheHolderOfTheLifelineHasEnded)
{
    Lifeline lifeline;
    const pid_t process = start(lifeline, stops);
    lifeline.hang_up();
    EXPECT_EQ(exit_code_of(process), 0);
}

TEST(StopSignal, ComesAtOnceWhenTheHolderHasEndedBefore)
{
    Lifeline lifeline;
    lifeline.hang_up();
    EXPECT_EQ(exit_code_of(start(lifeline, stops)), 0);
}

/// True if a program removed its folder at its end.
bool removes_folder(Lifeline& lifeline)
{
    std::string folder = "/tmp/hapnet-lifeline-XXXXXX";
    EXPECT_NE(mkdtemp(folder.data()), nullptr);
    const pid_t child = fork();
    if (child == 0) {
        if (lifeline.ends[1] >= 0) close(lifeline.ends[1]);
        setenv(lifeline_variable, std::to_string(lifeline.ends[0]).c_str(), 1);
        setenv(lifeline_folder_variable, folder.c_str(), 1);
        bool is_taken = false;
        {
            const StopSignal stop;
            is_taken = std::getenv(lifeline_folder_variable) == nullptr;
        }
        _exit(is_taken ? 0 : 1);
    }
    EXPECT_EQ(exit_code_of(child), 0);
    return rmdir(folder.c_str()) != 0;
}

TEST(StopSignal, RemovesTheFolderOfAHolderThatHasEndedAndOfNoOther)
{
    Lifeline held;
    EXPECT_FALSE(removes_folder(held));
    Lifeline lost;
    lost.hang_up();
    EXPECT_TRUE(removes_folder(lost));
}

TEST(StopSignal, ComesToEachOfTwoProgramsWithTheSameLifeline)
{
    Lifeline lifeline;
    const pid_t first = start(lifeline, stops);
    const pid_t second = start(lifeline, stops);
    lifeline.hang_up();
    EXPECT_EQ(exit_code_of(first), 0);
    EXPECT_EQ(exit_code_of(second), 0);
}

TEST(StopSignal, LeavesNothingOfTheLifelineToWhatTheProgramRuns)
{
    Lifeline lifeline;
    const auto look = [&](const StopSignal& /*stop*/) {
        if (std::getenv(lifeline_variable) != nullptr) return 1;
        constexpr int descriptors = 64;
        for (int i = 3; i < descriptors; ++i) {
            const int flags = fcntl(i, F_GETFD);
            const int status = fcntl(i, F_GETFL);
            if (flags >= 0 && (status & O_ASYNC) != 0 && (flags & FD_CLOEXEC) == 0) return 2;
        }
        return fcntl(lifeline.ends[0], F_GETFD) < 0 ? 0 : 3;
    };
    EXPECT_EQ(exit_code_of(start(lifeline, look)), 0);
}

TEST(StopSignal, HeedsNoLifelineThatIsNoPipe)
{
    const pid_t child = fork();
    if (child == 0) {
        const int file = open("/dev/null", O_RDONLY);
        setenv(lifeline_variable, std::to_string(file).c_str(), 1);
        const StopSignal of_file;
        setenv(lifeline_variable, "no number", 1);
        const StopSignal of_words;
        _exit(of_file.requested() || of_words.requested() ? 1 : 0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
}

} // namespace
} // namespace hapnet::net::stop_signal_test
