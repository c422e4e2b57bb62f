// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/child_command.hpp"

#include "proto/net/command_init.hpp"
#include "proto/net/own_network.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>
#include <tuple>
#include <unistd.h>

namespace hapnet::net {

namespace {

/// Forks. The child is the first process of a new PID namespace. Returns -1 if that is refused.
pid_t fork_first_process()
{
    return static_cast<pid_t>(
        syscall(SYS_clone, CLONE_NEWPID | SIGCHLD, nullptr, nullptr, nullptr, nullptr));
}

void close_all(std::initializer_list<int> descriptors)
{
    for (const int descriptor : descriptors) {
        if (descriptor >= 0) close(descriptor);
    }
}

/// Returns the terminal whose keys send signals to the group of this process; -1 if there is none.
int terminal_of_this_group()
{
    const int terminal = open("/dev/tty", O_RDWR | O_CLOEXEC | O_NOCTTY);
    if (terminal >= 0 && tcgetpgrp(terminal) != getpgrp()) {
        close(terminal);
        return -1;
    }
    return terminal;
}

} // namespace

ChildCommand::ChildCommand(const Setup& setup)
{
    if (!(setup.has_own_network && start(setup, /*has_own_processes*/ true))) {
        std::ignore = start(setup, /*has_own_processes*/ false);
    }
    if (!setup.has_own_group) terminal_ = terminal_of_this_group();
}

/// Starts the command. Returns false if the system refuses a PID namespace.
bool ChildCommand::start(const Setup& setup, bool has_own_processes)
{
    std::array<int, 2> orders{-1, -1};
    std::array<int, 2> ended{-1, -1};
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, orders.data()) != 0 ||
        pipe2(ended.data(), O_CLOEXEC | O_NONBLOCK) != 0) {
        deny_network(errno, "cannot make a channel to a child process");
    }
    const int self = static_cast<int>(syscall(SYS_pidfd_open, getpid(), 0));
    if (self < 0) deny_network(errno, "pidfd_open");
    pid_ = has_own_processes ? fork_first_process() : fork();
    const int error = errno;
    if (pid_ == 0) {
        close_all({orders[0], ended[0]});
        live_as_init(setup, {.orders = orders[1], .ended = ended[1], .parent = self},
                     has_own_processes);
    }
    close_all({orders[1], ended[1], self});
    init_ = orders[0];
    ended_ = ended[0];
    has_own_processes_ = has_own_processes;
    if (pid_ < 0 && !has_own_processes) deny_network(error, "fork");
    if (pid_ >= 0 && await_report()) return true;
    if (pid_ >= 0) waitpid(pid_, nullptr, 0);
    close_all({init_, ended_});
    pid_ = init_ = ended_ = -1;
    return false;
}

/// Waits for a report and throws the error in it. Returns false if the init has no usable PID
/// namespace.
bool ChildCommand::await_report()
{
    InitReport report;
    const auto count = recv(init_, &report, sizeof report, 0);
    if (count != static_cast<ssize_t>(sizeof report)) {
        deny_network(ECHILD, "the child process that starts the command has ended");
    }
    if (report.kind == InitReport::Kind::failed) deny_network(report.error, report.what.data());
    return report.kind == InitReport::Kind::done;
}

void ChildCommand::prepare()
{
    const InitOrder order{.kind = InitOrder::Kind::prepare};
    std::ignore = send(init_, &order, sizeof order, MSG_NOSIGNAL);
    await_report();
}

void ChildCommand::go()
{
    const InitOrder order{.kind = InitOrder::Kind::go};
    std::ignore = send(init_, &order, sizeof order, MSG_NOSIGNAL);
    await_report();
}

std::optional<int> ChildCommand::exit_code()
{
    if (exit_code_ || pid_ < 0) return exit_code_;
    int code = 0;
    const auto count = read(ended_, &code, sizeof code);
    if (count < 0) return std::nullopt; // the command still runs
    // No code means that the init was killed, and the command with it.
    exit_code_ = count == static_cast<ssize_t>(sizeof code) ? code : 128 + SIGKILL;
    give_terminal_back();
    return exit_code_;
}

/// A shell in a PID namespace makes its own group the foreground group of the terminal, and cannot
/// restore the previous one when it ends. Does nothing if the terminal belongs to a group that
/// still lives.
void ChildCommand::give_terminal_back() const
{
    if (terminal_ < 0) return;
    const pid_t group = tcgetpgrp(terminal_);
    if (group <= 0 || group == getpgrp()) return;
    if (kill(-group, 0) == 0 || errno != ESRCH) return;
    sigset_t stop;
    sigset_t before;
    sigemptyset(&stop);
    sigaddset(&stop, SIGTTOU);
    pthread_sigmask(SIG_BLOCK, &stop, &before);
    tcsetpgrp(terminal_, getpgrp());
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void ChildCommand::signal(int number)
{
    const InitOrder order{.kind = InitOrder::Kind::signal, .number = number};
    std::ignore = send(init_, &order, sizeof order, MSG_NOSIGNAL | MSG_DONTWAIT);
}

ChildCommand::~ChildCommand()
{
    if (pid_ >= 0) {
        const InitOrder order{.kind = InitOrder::Kind::end};
        if (has_own_processes_ || send(init_, &order, sizeof order, MSG_NOSIGNAL) < 0) {
            kill(pid_, SIGKILL);
        }
        waitpid(pid_, nullptr, 0);
        std::ignore = exit_code();
    }
    close_all({init_, ended_, terminal_});
}

} // namespace hapnet::net
