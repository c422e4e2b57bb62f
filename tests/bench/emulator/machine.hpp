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

/// How a program may use the machine: with SCHED_FIFO, or as an ordinary user's program that has no
/// privilege at all.
enum class Standing : std::uint8_t { real_time, ordinary };

/// The prober gets the first processor, the relay the second, where there are two.
void pin_prober();

/// Lets this thread have, or not have, SCHED_FIFO; nothing when the machine does not allow it.
void set_real_time(bool on);

/// What a command prints until it ends, on any processor; its stderr goes nowhere.
[[nodiscard]] std::string output_of(const std::vector<std::string>& words);

/// A process on each processor that never sleeps, with the priority of any program. They end when
/// this goes out of scope, and when the bench is killed.
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

/// A relay that runs as a child: it prints "ready a=HOST:PORT b=HOST:PORT", or what else it listens
/// to, when its sockets are bound. Stopped when it goes out of scope.
class RelayProcess {
public:
    /// Throws std::runtime_error when it does not become ready.
    RelayProcess(const std::vector<std::string>& words, Standing standing);
    ~RelayProcess();
    RelayProcess(const RelayProcess&) = delete;
    RelayProcess& operator=(const RelayProcess&) = delete;

    /// Its ready line.
    [[nodiscard]] const std::string& ready() const { return ready_; }
    /// Where datagrams for B are to be sent, of one pair.
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
