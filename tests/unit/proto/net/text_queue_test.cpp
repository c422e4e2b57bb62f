// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/text_queue.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <string>
#include <thread>
#include <unistd.h>

namespace hapnet::net {
namespace {

struct OpenPipe {
    explicit OpenPipe(int flags = 0) { EXPECT_EQ(pipe2(ends.data(), O_CLOEXEC | flags), 0); }
    ~OpenPipe()
    {
        close(ends[0]);
        close(ends[1]);
    }
    OpenPipe(const OpenPipe&) = delete;
    OpenPipe& operator=(const OpenPipe&) = delete;

    std::array<int, 2> ends{};
};

TEST(TextQueue, WritesAllInItsOrder)
{
    for (const int flags : {0, O_NONBLOCK}) { // another process may have set it
        const OpenPipe pipe{flags};
        std::string expected;
        std::string got;
        std::thread reader{[&] {
            std::array<char, 1000> block{};
            while (got.size() < 3895) { // a pipe gives its present bytes
                const auto count = read(pipe.ends[0], block.data(), block.size());
                if (count > 0) got.append(block.data(), static_cast<std::size_t>(count));
            }
        }};
        {
            TextQueue queue{pipe.ends[1]};
            for (int i = 0; i < 1001; ++i) {
                const std::string text = std::to_string(i) + "\n";
                expected += text;
                queue.put(text);
            }
            EXPECT_EQ(expected.size(), 3895U);
            while (!queue.is_done()) std::this_thread::yield();
            EXPECT_EQ(queue.written(), expected.size());
            EXPECT_EQ(queue.lost(), 0U);
            EXPECT_EQ(queue.error(), 0);
        }
        reader.join();
        EXPECT_EQ(got, expected);
    }
}

TEST(TextQueue, DropsAndCountsWhatFindsNoRoomAndNeverWaits)
{
    std::signal(SIGPIPE, SIG_IGN);
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
    TextQueue queue{ends[1]};
    const std::string text(1000, '.');
    for (int i = 0; i < 1000; ++i) queue.put(text); // the pipe takes 65 of them
    EXPECT_GE(queue.lost(), 1000U - 66 - TextQueue::bytes_max / 1000);
    EXPECT_LT(queue.lost(), 1000U);
    EXPECT_FALSE(queue.is_done());
    close(ends[0]); // the queue does not wait for text that cannot be written
    while (!queue.is_done()) std::this_thread::yield();
    EXPECT_EQ(queue.error(), EPIPE);
    close(ends[1]);
}

} // namespace
} // namespace hapnet::net
