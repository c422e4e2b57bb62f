// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/standard_streams.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hapnet::net {
namespace {

TEST(StandardStreams, KeepTheirNumbersFromWhatIsOpenedNext)
{
    for (int closed = 0; closed < 8; ++closed) { // one bit for each of the three
        const pid_t child = fork();
        if (child == 0) {
            for (int descriptor = 0; descriptor < 3; ++descriptor) {
                if ((closed >> descriptor & 1) != 0) close(descriptor);
            }
            fill_standard_streams();
            const int next = open("/dev/null", O_RDWR | O_CLOEXEC);
            bool fails = true; // as before: what is asked to print says that it cannot
            for (int descriptor = 1; descriptor < 3; ++descriptor) {
                if ((closed >> descriptor & 1) == 0) continue;
                fails = fails && write(descriptor, "x", 1) < 0;
            }
            _exit(next > 2 && fails ? 0 : 1);
        }
        int status = -1;
        waitpid(child, &status, 0);
        EXPECT_EQ(status, 0) << closed;
    }
}

} // namespace
} // namespace hapnet::net
