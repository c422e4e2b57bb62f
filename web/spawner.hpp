// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <string>
#include <sys/types.h>
#include <thread>
#include <vector>

namespace hapnet::web {

/// A command to start.
struct Command {
    std::vector<std::string> words; // the program first, with its path
    std::string log;                // receives stderr, and stdout unless that is wanted
    bool wants_output = false;
};

/// A process that was started.
struct Child {
    pid_t pid = -1;
    int ended = -1;  // a descriptor that is readable when it has ended
    int output = -1; // its stdout; -1: not wanted
};

/// Starts processes from a thread of its own. Children inherit the priority of the thread that
/// starts them. This thread keeps the priority with which the program was started, while the
/// server's is low. The children are programs of this project and hold a lifeline
/// (proto/net/stop_signal.hpp): they stop when this program has ended, whatever ended it.
class Spawner {
public:
    Spawner();
    ~Spawner();
    Spawner(const Spawner&) = delete;
    Spawner& operator=(const Spawner&) = delete;

    /// Starts a process. Throws std::system_error.
    [[nodiscard]] Child start(const Command& command);

private:
    void serve();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::packaged_task<Child()>> tasks_;
    bool is_over_ = false;
    std::array<int, 2> lifeline_{-1, -1};
    std::thread thread_; // last member: the thread uses the others
};

} // namespace hapnet::web
