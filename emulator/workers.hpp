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

/// Threads that relay in addition to the main one, each its own part of a run. The main thread
/// stops them between two rounds to read or change their data. They share nothing else, and a round
/// costs them no more than a free lock.
class Workers {
public:
    /// The part of one thread.
    struct Part {
        std::vector<int> descriptors; // descriptors to wait for
        std::function<std::optional<base::TimePoint>()> next_deadline;
        std::function<void()> relay; // relays datagrams that have arrived or are due
    };

    /// Starts a thread for each part. The threads wait as Pacer does, with real-time scheduling
    /// where it is allowed.
    Workers(std::vector<Part> parts, Timing timing);
    /// Stops the threads.
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    [[nodiscard]] bool empty() const { return workers_.empty(); }

    /// Keeps all workers out of their rounds while an object of this class exists. Afterwards each
    /// worker reads its deadline again.
    class Rest {
    public:
        explicit Rest(Workers& workers);
        ~Rest();
        Rest(const Rest&) = delete;
        Rest& operator=(const Rest&) = delete;

    private:
        Workers& workers_;
    };

    /// Returns a descriptor that is readable once a worker has failed.
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
