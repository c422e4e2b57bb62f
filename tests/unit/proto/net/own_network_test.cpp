// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/own_network.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hapnet::net {
namespace {

/// A process in a network namespace, which opens a socket on command.
class Neighbour {
public:
    Neighbour(int family, int type)
    {
        if (pipe(orders_.data()) != 0 || pipe(reports_.data()) != 0) return;
        child_ = fork();
        if (child_ == 0) be_child(family, type);
    }
    ~Neighbour()
    {
        for (const int end : {orders_[0], orders_[1], reports_[0], reports_[1]}) close(end);
        if (child_ <= 0) return;
        kill(child_, SIGKILL);
        waitpid(child_, nullptr, 0);
    }
    Neighbour(const Neighbour&) = delete;
    Neighbour& operator=(const Neighbour&) = delete;

    [[nodiscard]] pid_t pid() const { return child_; }
    /// True once the next step is done: the network, and then the socket.
    [[nodiscard]] bool does_next()
    {
        char word = 'x';
        return write(orders_[1], &word, 1) == 1 && read(reports_[0], &word, 1) == 1 && word == 'y';
    }

private:
    [[noreturn]] void be_child(int family, int type) const
    {
        const auto answer = [&](bool is_done) {
            const char word = is_done ? 'y' : 'n';
            if (write(reports_[1], &word, 1) != 1) _exit(1);
        };
        char order = 'x';
        if (read(orders_[0], &order, 1) == 1) answer(unshare(CLONE_NEWNET) == 0);
        if (read(orders_[0], &order, 1) == 1) {
            const int own = socket(family, type, 0);
            sockaddr_storage any{}; // any address and port
            any.ss_family = static_cast<sa_family_t>(family);
            const auto size = family == AF_INET ? sizeof(sockaddr_in) : sizeof(sockaddr_in6);
            answer(bind(own, reinterpret_cast<sockaddr*>(&any), static_cast<socklen_t>(size)) ==
                       0 &&
                   (type == SOCK_DGRAM || listen(own, 1) == 0));
        }
        while (true) pause();
    }

    std::array<int, 2> orders_{-1, -1};
    std::array<int, 2> reports_{-1, -1};
    pid_t child_ = -1;
};

struct Kind {
    int family;
    int type;
};

class HasListener : public testing::TestWithParam<Kind> {};

TEST_P(HasListener, SeesASocketOfAnotherNetworkAndNotThoseOfItsOwn)
{
    if (geteuid() != 0) GTEST_SKIP() << "needs root, to look into another network";
    const int own = socket(AF_INET, SOCK_STREAM, 0); // in this network
    ASSERT_EQ(listen(own, 1), 0);
    Neighbour neighbour{GetParam().family, GetParam().type};
    if (!neighbour.does_next()) {
        close(own);
        GTEST_SKIP() << "no networks of one's own here";
    }
    EXPECT_FALSE(has_listener(neighbour.pid()));
    if (!neighbour.does_next()) {
        close(own);
        GTEST_SKIP() << "no IPv6 here";
    }
    EXPECT_TRUE(has_listener(neighbour.pid()));
    EXPECT_TRUE(has_listener(getpid())) << "back in its own network";
    close(own);
}

INSTANTIATE_TEST_SUITE_P(Sockets, HasListener,
                         testing::Values(Kind{AF_INET, SOCK_STREAM}, Kind{AF_INET6, SOCK_STREAM},
                                         Kind{AF_INET, SOCK_DGRAM}, Kind{AF_INET6, SOCK_DGRAM}));

} // namespace
} // namespace hapnet::net
