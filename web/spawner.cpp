// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/spawner.hpp"

#include "proto/disk/create.hpp"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::web {

namespace {

[[noreturn]] void refuse(const char* what)
{
    throw std::system_error{errno, std::generic_category(), what};
}

/// Only what is permitted between fork() and exec() of a program with threads.
[[noreturn]] void become(char* const* words, int log, int output, pid_t parent)
{
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(126);
    setpgid(0, 0);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    signal(SIGPIPE, SIG_DFL);
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    dup2(nothing, STDIN_FILENO);
    dup2(output >= 0 ? output : log, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
    execv(words[0], words);
    _exit(127);
}

Child start_now(const Command& command)
{
    const auto log = disk::open_to_write(command.log, O_WRONLY | O_APPEND, 0600);
    if (!log) throw std::system_error{log.error(), command.log};
    int pipe_ends[2] = {-1, -1};
    if (command.wants_output && pipe2(pipe_ends, O_CLOEXEC) != 0) refuse("pipe");
    std::vector<std::string> words = command.words;
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const pid_t parent = getpid();
    const pid_t pid = fork();
    if (pid == 0) become(pointers.data(), log->number(), pipe_ends[1], parent);
    const int error = errno;
    if (pipe_ends[1] >= 0) close(pipe_ends[1]);
    errno = error;
    if (pid < 0) refuse("fork");
    const int ended = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
    if (ended < 0) refuse("pidfd_open");
    return {pid, ended, pipe_ends[0]};
}

} // namespace

Spawner::Spawner() : thread_{[this] { serve(); }} {}

Spawner::~Spawner()
{
    {
        const std::lock_guard lock{mutex_};
        is_over_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

Child Spawner::start(const Command& command)
{
    std::packaged_task<Child()> task{[command] { return start_now(command); }};
    auto child = task.get_future();
    {
        const std::lock_guard lock{mutex_};
        tasks_.push_back(std::move(task));
    }
    changed_.notify_one();
    return child.get();
}

void Spawner::serve()
{
    std::unique_lock lock{mutex_};
    while (true) {
        changed_.wait(lock, [this] { return is_over_ || !tasks_.empty(); });
        if (tasks_.empty()) return;
        auto task = std::move(tasks_.front());
        tasks_.pop_front();
        lock.unlock();
        task();
        lock.lock();
    }
}

} // namespace hapnet::web
