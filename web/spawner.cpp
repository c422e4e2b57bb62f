// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/spawner.hpp"

#include "proto/disk/create.hpp"
#include "proto/net/stop_signal.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::web {

namespace {

[[noreturn]] void refuse(const char* what)
{
    throw std::system_error{errno, std::generic_category(), what};
}

std::vector<char*> pointers_to(std::vector<std::string>& texts)
{
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// Returns the environment of this program, with its lifeline.
std::vector<std::string> environment_with(int lifeline)
{
    const auto name = fmt::format("{}=", net::lifeline_variable);
    std::vector<std::string> variables{fmt::format("{}{}", name, lifeline)};
    for (char** variable = environ; *variable != nullptr; ++variable) {
        if (!std::string_view{*variable}.starts_with(name)) variables.emplace_back(*variable);
    }
    return variables;
}

/// The data of a process that is to be started.
struct Image {
    char* const* words;
    char* const* environment;
    int lifeline;
    int log;
    int output; // -1: stdout goes to the log
};

/// Becomes the program. It calls only functions that are allowed between fork() and exec() in a
/// program with threads.
[[noreturn]] void become(const Image& image)
{
    setpgid(0, 0);
    fcntl(image.lifeline, F_SETFD, 0); // only this child's program inherits it
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    signal(SIGPIPE, SIG_DFL);
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    dup2(nothing, STDIN_FILENO);
    dup2(image.output >= 0 ? image.output : image.log, STDOUT_FILENO);
    dup2(image.log, STDERR_FILENO);
    execve(image.words[0], image.words, image.environment);
    _exit(127);
}

Child start_now(const Command& command, int lifeline)
{
    const auto log = disk::open_to_write(command.log, O_WRONLY | O_APPEND, 0600);
    if (!log) throw std::system_error{log.error(), command.log};
    int pipe_ends[2] = {-1, -1};
    if (command.wants_output && pipe2(pipe_ends, O_CLOEXEC) != 0) refuse("pipe");
    std::vector<std::string> words = command.words;
    std::vector<std::string> environment = environment_with(lifeline);
    const auto word_pointers = pointers_to(words);
    const auto variable_pointers = pointers_to(environment);
    const pid_t pid = fork();
    if (pid == 0) {
        become({word_pointers.data(), variable_pointers.data(), lifeline, log->number(),
                pipe_ends[1]});
    }
    const int error = errno;
    if (pipe_ends[1] >= 0) close(pipe_ends[1]);
    errno = error;
    if (pid < 0) refuse("fork");
    const int ended = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
    if (ended < 0) {
        const int why = errno;
        kill(pid, SIGKILL);
        waitpid(pid, nullptr, 0);
        if (pipe_ends[0] >= 0) close(pipe_ends[0]);
        errno = why;
        refuse("pidfd_open");
    }
    return {pid, ended, pipe_ends[0]};
}

} // namespace

Spawner::Spawner()
{
    if (pipe2(lifeline_.data(), O_CLOEXEC) != 0) refuse("pipe");
    thread_ = std::thread{[this] { serve(); }};
}

Spawner::~Spawner()
{
    {
        const std::lock_guard lock{mutex_};
        is_over_ = true;
    }
    changed_.notify_one();
    thread_.join();
    for (const int end : lifeline_) close(end);
}

Child Spawner::start(const Command& command)
{
    std::packaged_task<Child()> task{
        [command, lifeline = lifeline_[0]] { return start_now(command, lifeline); }};
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
