// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/options.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace hapnet::emulator {

/// Threads that relay beside the main one, each its own part of a run. The main thread stops them
/// between two rounds to look at what they work with, or to change it: they share nothing else, and
/// a round costs them no more than a free lock.
class Workers {
public:
    /// The part of one thread.
    struct Part {
        std::vector<int> descriptors; // descriptors to wait for
        std::function<std::optional<base::TimePoint>()> next_deadline;
        std::function<void()> relay; // relays what has come and what is due
    };

    /// Starts a thread for each part. They wait as Pacer does, with real-time scheduling where it
    /// is allowed.
    Workers(std::vector<Part> parts, Timing timing);
    /// Stops them.
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    [[nodiscard]] bool empty() const { return workers_.empty(); }

    /// Keeps all workers out of their rounds as long as one of these lives. Afterwards each looks
    /// at its deadline again.
    class Rest {
    public:
        explicit Rest(Workers& workers);
        ~Rest();
        Rest(const Rest&) = delete;
        Rest& operator=(const Rest&) = delete;

    private:
        Workers& workers_;
    };

    /// Readable once a worker has failed.
    [[nodiscard]] int descriptor() const;
    [[nodiscard]] bool has_failed() const;

    /// Ends the threads. Throws the error with which one of them has failed.
    void stop();

private:
    struct Alarm;
    class Worker;

    void join();

    std::unique_ptr<Alarm> alarm_;
    std::vector<std::unique_ptr<Worker>> workers_;
};

} // namespace hapnet::emulator
