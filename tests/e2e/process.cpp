// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/e2e/process.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <poll.h>
#include <sstream>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <tuple>
#include <unistd.h>

namespace hapnet::e2e {

namespace {

using Clock = std::chrono::steady_clock;

struct Pipe {
    Pipe()
    {
        if (pipe2(ends.data(), O_CLOEXEC) != 0) {
            throw std::system_error{errno, std::generic_category(), "pipe"};
        }
    }
    std::array<int, 2> ends{};
};

[[noreturn]] void become(const std::string& path, std::vector<char*>& words)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    execv(path.c_str(), words.data());
    _exit(127); // as a shell says "not found"
}

std::optional<std::string> line_with(std::string_view text, std::string_view words)
{
    while (!text.empty()) {
        const auto end = text.find('\n');
        if (end == std::string_view::npos) return std::nullopt; // not complete yet
        const auto line = text.substr(0, end);
        if (line.find(words) != std::string_view::npos) return std::string{line};
        text.remove_prefix(end + 1);
    }
    return std::nullopt;
}

/// Returns the exit code as a shell reports it.
int exit_code_of(int status)
{
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

} // namespace

Process::Process(std::string_view name, const std::vector<std::string>& arguments)
{
    std::vector<std::string> texts{std::string{HAPNET_BIN_DIR "/"}.append(name)};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<char*> words;
    for (std::string& text : texts) words.push_back(text.data());
    words.push_back(nullptr);

    const Pipe out;
    const Pipe err;
    pid_ = fork();
    if (pid_ < 0) throw std::system_error{errno, std::generic_category(), "fork"};
    if (pid_ == 0) {
        dup2(out.ends[1], STDOUT_FILENO);
        dup2(err.ends[1], STDERR_FILENO);
        become(texts[0], words);
    }
    close(out.ends[1]);
    close(err.ends[1]);
    out_.descriptor = out.ends[0];
    err_.descriptor = err.ends[0];
}

Process::~Process()
{
    signal(SIGKILL);
    if (!exit_) waitpid(pid_, nullptr, 0);
    for (const Stream* stream : {&out_, &err_}) {
        if (stream->descriptor >= 0) close(stream->descriptor);
    }
}

void Process::signal(int number) const
{
    if (!exit_) kill(pid_, number);
}

void Process::pause()
{
    signal(SIGSTOP);
    int status = 0;
    if (!exit_ && waitpid(pid_, &status, WUNTRACED) == pid_ && !WIFSTOPPED(status))
        exit_ = exit_code_of(status);
}

void Process::collect(Clock::time_point deadline)
{
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    std::array<pollfd, 2> polled{{{out_.descriptor, POLLIN, 0}, {err_.descriptor, POLLIN, 0}}};
    poll(polled.data(), polled.size(), static_cast<int>(std::max<long>(0, left.count())));
    for (std::size_t i = 0; i < polled.size(); ++i) {
        if (polled[i].revents == 0) continue;
        Stream& stream = i == 0 ? out_ : err_;
        std::array<char, 65536> buffer{};
        const auto count = read(stream.descriptor, buffer.data(), buffer.size());
        if (count > 0) {
            stream.text.append(buffer.data(), static_cast<std::size_t>(count));
        } else if (count == 0) {
            close(stream.descriptor);
            stream.descriptor = -1;
        }
    }
}

std::optional<std::string> Process::wait_for(const Stream& stream, std::string_view words,
                                             std::chrono::milliseconds timeout)
{
    const auto deadline = Clock::now() + timeout;
    for (;;) {
        if (auto line = line_with(stream.text, words)) return line;
        if (stream.descriptor < 0 || Clock::now() >= deadline) return std::nullopt;
        collect(deadline);
    }
}

std::optional<std::string> Process::wait_for_out(std::string_view words,
                                                 std::chrono::milliseconds timeout)
{
    return wait_for(out_, words, timeout);
}

std::optional<std::string> Process::wait_for_err(std::string_view words,
                                                 std::chrono::milliseconds timeout)
{
    return wait_for(err_, words, timeout);
}

std::optional<int> Process::wait_exit(std::chrono::milliseconds timeout)
{
    const auto deadline = Clock::now() + timeout;
    while (!exit_) {
        int status = 0;
        if (waitpid(pid_, &status, WNOHANG) == pid_) {
            exit_ = exit_code_of(status);
            break;
        }
        const auto now = Clock::now();
        if (now >= deadline) return std::nullopt;
        const auto next = std::min(deadline, now + std::chrono::milliseconds{5});
        if (out_.descriptor >= 0 || err_.descriptor >= 0) {
            collect(next);
        } else {
            std::this_thread::sleep_until(next);
        }
    }
    return exit_;
}

const std::string& Process::out()
{
    collect(Clock::now());
    return out_.text;
}

const std::string& Process::err()
{
    collect(Clock::now());
    return err_.text;
}

Outcome run(std::string_view name, const std::vector<std::string>& arguments,
            std::chrono::milliseconds timeout)
{
    Process process{name, arguments};
    const auto exit = process.wait_exit(timeout);
    if (!exit) process.signal(SIGKILL);
    // A stream ends when its last writer has ended. The rest in the pipe can still be read.
    std::ignore = process.wait_for_out("\n", std::chrono::seconds{1});
    std::ignore = process.wait_for_err("\n", std::chrono::seconds{1});
    return {exit, process.out(), process.err()};
}

void expect_refusal(const Outcome& outcome, int exit, const std::vector<std::string>& words)
{
    EXPECT_EQ(outcome.exit, exit) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    for (const std::string& word : words) {
        EXPECT_NE(outcome.err.find(word), std::string::npos) << word << "\n" << outcome.err;
    }
}

TemporaryFolder::TemporaryFolder()
{
    std::string pattern = (std::filesystem::temp_directory_path() / "hapnet-e2e-XXXXXX").string();
    base::ensure(mkdtemp(pattern.data()) != nullptr);
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryFolder::file(std::string_view name) const
{
    return path_ + "/" + std::string{name};
}

std::vector<std::string> TemporaryFolder::names() const
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator{path_}) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::string text_of(const std::string& file)
{
    const std::ifstream stream{file};
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

} // namespace hapnet::e2e
