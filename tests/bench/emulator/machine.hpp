// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"

#include <string>
#include <sys/types.h>
#include <utility>
#include <vector>

namespace hapnet::bench {

/// The standing of a program on the machine: with SCHED_FIFO, or as an ordinary user without any
/// privilege.
enum class Standing : std::uint8_t { real_time, ordinary };

/// Pins the prober to the first processor. The relay gets the second, if there are two.
void pin_prober();

/// Sets or clears SCHED_FIFO for this thread. Does nothing when the machine does not allow it.
void set_real_time(bool on);

/// Runs a command until it ends, on any processor, and returns its stdout. Its stderr is discarded.
[[nodiscard]] std::string output_of(const std::vector<std::string>& words);

/// One process on each processor that never sleeps, at ordinary priority. They end with this
/// object, and when the bench is killed.
class BusyProcesses {
public:
    /// Throws std::system_error.
    BusyProcesses();
    ~BusyProcesses();
    BusyProcesses(const BusyProcesses&) = delete;
    BusyProcesses& operator=(const BusyProcesses&) = delete;

    [[nodiscard]] const std::vector<pid_t>& ids() const { return ids_; }

private:
    std::vector<pid_t> ids_;
};

/// The processor time that a process has used so far, to the nanosecond; 0 when there is none.
[[nodiscard]] base::Duration time_used_by(pid_t process);

/// A relay that runs as a child: it prints "ready a=HOST:PORT b=HOST:PORT", or its other sockets,
/// when its sockets are bound. Stopped when it goes out of scope.
class RelayProcess {
public:
    /// Throws std::runtime_error when it does not become ready.
    RelayProcess(const std::vector<std::string>& words, Standing standing);
    ~RelayProcess();
    RelayProcess(const RelayProcess&) = delete;
    RelayProcess& operator=(const RelayProcess&) = delete;

    /// Returns its ready line.
    [[nodiscard]] const std::string& ready() const { return ready_; }
    /// The address of one pair that takes datagrams for B.
    [[nodiscard]] net::Endpoint a() const;

    /// The processor time that it has used so far, to the nanosecond.
    [[nodiscard]] base::Duration used() const { return time_used_by(pid_); }

private:
    struct Started {
        pid_t pid = -1;
        std::string ready;
    };
    static Started start(const std::vector<std::string>& words, Standing standing);
    explicit RelayProcess(Started started) : pid_{started.pid}, ready_{std::move(started.ready)} {}

    pid_t pid_;
    std::string ready_;
};

} // namespace hapnet::bench
