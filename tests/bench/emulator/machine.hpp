// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"

#include <string>
#include <sys/types.h>
#include <vector>

namespace hapnet::bench {

/// How a program may use the machine: with SCHED_FIFO, or as an ordinary user's program that has no
/// privilege at all.
enum class Standing : std::uint8_t { real_time, ordinary };

/// The prober gets the first processor, the relay the second, where there are two.
void pin_prober();

/// Lets this thread have, or not have, SCHED_FIFO; nothing when the machine does not allow it.
void set_real_time(bool on);

/// A relay that runs as a child: it prints "ready a=HOST:PORT b=HOST:PORT" when its sockets are
/// bound. Stopped when it goes out of scope.
class RelayProcess {
public:
    /// Throws std::runtime_error when it does not become ready.
    RelayProcess(const std::vector<std::string>& words, Standing standing);
    ~RelayProcess();
    RelayProcess(const RelayProcess&) = delete;
    RelayProcess& operator=(const RelayProcess&) = delete;

    /// Where datagrams for B are to be sent.
    [[nodiscard]] const net::Endpoint& a() const { return a_; }

    /// The processor time that it has used so far, to the nanosecond.
    [[nodiscard]] base::Duration used() const;

private:
    struct Started {
        pid_t pid = -1;
        net::Endpoint a;
    };
    static Started start(const std::vector<std::string>& words, Standing standing);
    explicit RelayProcess(const Started& started) : pid_{started.pid}, a_{started.a} {}

    pid_t pid_;
    net::Endpoint a_;
};

} // namespace hapnet::bench
