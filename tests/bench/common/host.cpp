// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/common/host.hpp"

#include <array>
#include <cstdlib>
#include <fstream>
#include <sched.h>
#include <sys/utsname.h>
#include <thread>

namespace hapnet::bench {

namespace {

std::string processor_name()
{
    std::ifstream file{"/proc/cpuinfo"};
    for (std::string line; std::getline(file, line);) {
        const auto colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return "unknown";
}

} // namespace

Host host()
{
    Host host;
    host.cpu = processor_name();
    utsname system{};
    if (uname(&system) == 0) host.kernel = system.release;
    host.cores = static_cast<int>(std::thread::hardware_concurrency());
    host.fifo = set_fifo(1);
    set_fifo(0);
    std::array<double, 1> loads{};
    if (getloadavg(loads.data(), 1) == 1) host.load = loads[0];
    return host;
}

void pin(unsigned int processor)
{
    if (std::thread::hardware_concurrency() < 2) return;
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(processor, &set);
    sched_setaffinity(0, sizeof set, &set);
}

bool set_fifo(int priority)
{
    const sched_param parameters{.sched_priority = priority};
    return sched_setscheduler(0, priority > 0 ? SCHED_FIFO : SCHED_OTHER, &parameters) == 0;
}

} // namespace hapnet::bench
