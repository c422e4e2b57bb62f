// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/file_limit.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hapnet::net {
namespace {

/// Returns the end of a child that runs `work` where no file may grow beyond 10 bytes.
template <typename Work>
int status_after(void (*handler)(int), const Work& work)
{
    const pid_t child = fork();
    if (child == 0) {
        std::signal(SIGXFSZ, handler);
        const rlimit limit{10, 10};
        setrlimit(RLIMIT_FSIZE, &limit);
        const rlimit no_core{0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        survive_file_limit();
        _exit(work());
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return status;
}

int write_20_bytes()
{
    FILE* const file = std::tmpfile();
    const std::array<char, 20> bytes{};
    const auto first = write(fileno(file), bytes.data(), bytes.size());
    const auto second = write(fileno(file), bytes.data(), bytes.size());
    return first == 10 && second == -1 && errno == EFBIG ? 0 : 1;
}

int become_one_that_dies()
{
    execl("/bin/sh", "sh", "-c", "kill -XFSZ $$; exit 7", nullptr); // NOLINT(*-vararg)
    return 1;
}

TEST(FileLimit, IsAnErrorAndNotTheEnd)
{
    const int status = status_after(SIG_DFL, write_20_bytes);
    ASSERT_TRUE(WIFEXITED(status)) << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(FileLimit, EndsTheCommandsThatAProgramStartsAsBefore)
{
    const int status = status_after(SIG_DFL, become_one_that_dies);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), SIGXFSZ);
}

TEST(FileLimit, StaysIgnoredWhereItWas)
{
    EXPECT_EQ(WEXITSTATUS(status_after(SIG_IGN, write_20_bytes)), 0);
    const int status = status_after(SIG_IGN, become_one_that_dies);
    ASSERT_TRUE(WIFEXITED(status)) << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 7);
}

} // namespace
} // namespace hapnet::net
