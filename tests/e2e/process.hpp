// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <thread>
#include <vector>

namespace hapnet::e2e {

/// A running program of this build. Its stdout and stderr are collected in out(), err() and the
/// wait functions. It is killed with SIGKILL and reaped when the object ends, and also dies with
/// the test program.
class Process {
public:
    /// Starts `name`, one of the programs of this build, e.g. "hapnet-emulator".
    Process(std::string_view name, const std::vector<std::string>& arguments);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// The first line of stdout (stderr) that contains `words`, without its newline. Waits for it;
    /// nullopt when the program has closed the stream, or `timeout` has passed, without one.
    std::optional<std::string> wait_for_out(std::string_view words,
                                            std::chrono::milliseconds timeout);
    std::optional<std::string> wait_for_err(std::string_view words,
                                            std::chrono::milliseconds timeout);

    /// Returns the exit code; 128 + n when signal n killed it, as a shell reports it; nullopt when
    /// it still runs after `timeout`.
    std::optional<int> wait_exit(std::chrono::milliseconds timeout);

    /// Sends SIGTERM, SIGKILL, SIGCONT, ...; nothing when it has been reaped.
    void signal(int number) const;
    /// Sends SIGSTOP, and waits until all threads have stopped. The signal waits for a thread that
    /// takes it, and until then the others continue: on a busy machine for tens of milliseconds.
    void pause();

    [[nodiscard]] pid_t pid() const { return pid_; }

    /// All output so far.
    [[nodiscard]] const std::string& out();
    [[nodiscard]] const std::string& err();

private:
    struct Stream {
        int descriptor = -1; // -1 once closed by the program
        std::string text;
    };

    /// Takes what is there, waiting for it until `deadline` at most.
    void collect(std::chrono::steady_clock::time_point deadline);
    std::optional<std::string> wait_for(const Stream& stream, std::string_view words,
                                        std::chrono::milliseconds timeout);

    pid_t pid_ = -1;
    std::optional<int> exit_;
    Stream out_;
    Stream err_;
};

/// True if the condition holds within `most`. It is checked every few milliseconds, so that a test
/// waits for a state and not for a time.
template <typename Condition>
[[nodiscard]] bool comes_true(Condition condition,
                              std::chrono::milliseconds most = std::chrono::seconds{20})
{
    const auto deadline = std::chrono::steady_clock::now() + most;
    while (!condition()) {
        if (std::chrono::steady_clock::now() >= deadline) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds{5});
    }
    return true;
}

/// The result of a program that ends by itself.
struct Outcome {
    std::optional<int> exit; // nullopt: it did not end in time and was killed
    std::string out;
    std::string err;
};
[[nodiscard]] Outcome run(std::string_view name, const std::vector<std::string>& arguments,
                          std::chrono::milliseconds timeout = std::chrono::seconds{20});

/// Expects this exit code, no stdout, and these words on stderr.
void expect_refusal(const Outcome& outcome, int exit, const std::vector<std::string>& words);

/// An empty folder for one test; removed with all it holds when it goes out of scope.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] std::string file(std::string_view name) const;

    /// The names of what it holds, sorted.
    [[nodiscard]] std::vector<std::string> names() const;

private:
    std::string path_;
};

/// The text of a file; empty when there is none.
[[nodiscard]] std::string text_of(const std::string& file);

} // namespace hapnet::e2e
