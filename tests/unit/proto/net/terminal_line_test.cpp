// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/terminal_line.hpp"

#include <array>
#include <cstdlib>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace hapnet::net::terminal_line_test {
namespace {

/// A terminal of a given width.
class Terminal {
public:
    explicit Terminal(unsigned short columns) : descriptor_{posix_openpt(O_RDWR | O_NOCTTY)}
    {
        const winsize size{.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
        EXPECT_EQ(ioctl(descriptor_, TIOCSWINSZ, &size), 0);
    }
    ~Terminal() { close(descriptor_); }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    [[nodiscard]] int descriptor() const { return descriptor_; }

private:
    int descriptor_;
};

TEST(TerminalLine, ShowsControlCharactersOfItsTextInsteadOfObeyingThem)
{
    const Terminal terminal{80};
    TerminalLine line{terminal.descriptor()};
    EXPECT_EQ(line.shown("a\x1b[2J\n"), "\r\x1b[Ka\\u001B[2J\\u000A");
}

TEST(TerminalLine, WritesOverItselfAndMakesRoomForOtherText)
{
    const Terminal terminal{80};
    TerminalLine line{terminal.descriptor()};
    EXPECT_TRUE(line.is_terminal());
    EXPECT_EQ(line.room(), "");
    EXPECT_EQ(line.shown("one"), "\r\x1b[Kone");
    EXPECT_EQ(line.shown("two"), "\r\x1b[Ktwo");
    EXPECT_EQ(line.room(), "\r\x1b[K");
    EXPECT_EQ(line.room(), "");
    EXPECT_EQ(line.left(), "");
    EXPECT_EQ(line.shown("three"), "\r\x1b[Kthree");
    EXPECT_EQ(line.left(), "\n");
    EXPECT_EQ(line.left(), "");
}

TEST(TerminalLine, IsCutWhereItWouldBeFolded)
{
    const Terminal terminal{5};
    TerminalLine line{terminal.descriptor()};
    EXPECT_EQ(line.shown("123456"), "\r\x1b[K12345");
}

TEST(TerminalLine, KnowsWhatIsNoTerminal)
{
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    EXPECT_FALSE(TerminalLine{ends[1]}.is_terminal());
    close(ends[0]);
    close(ends[1]);
}

} // namespace
} // namespace hapnet::net::terminal_line_test
