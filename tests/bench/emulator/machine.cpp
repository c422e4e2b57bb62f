// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/emulator/machine.hpp"

#include "tests/bench/common/host.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <fcntl.h>
#include <linux/capability.h>
#include <sched.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace hapnet::bench {

namespace {

constexpr int relay_priority = 40; // as hapnet-emulator requests
constexpr int prober_priority = 30;

/// Gives up the privileges of root that concern timing.
void give_up_privileges()
{
    for (const int capability : {CAP_SYS_NICE, CAP_IPC_LOCK, CAP_NET_ADMIN, CAP_SYS_RESOURCE}) {
        prctl(PR_CAPBSET_DROP, static_cast<unsigned long>(capability), 0, 0,
              0); // takes effect with exec
    }
    const rlimit none{0, 0};
    setrlimit(RLIMIT_RTPRIO, &none);
    const rlimit usual{8U << 20U, 8U << 20U};
    setrlimit(RLIMIT_MEMLOCK, &usual);
    set_fifo(0);
}

/// A child that runs `prepare` and then becomes a command. Its stdout can be read from the
/// descriptor.
struct Child {
    pid_t pid = -1;
    int out = -1;
};

Child spawn(const std::vector<std::string>& words, const auto& prepare)
{
    std::vector<std::string> texts = words;
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
        throw std::system_error{errno, std::generic_category(), "pipe"};
    }
    const pid_t pid = fork();
    if (pid < 0) throw std::system_error{errno, std::generic_category(), "fork"};
    if (pid == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        dup2(ends[1], STDOUT_FILENO);
        if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(126);
        prepare();
        execv(pointers.front(), pointers.data());
        _exit(127);
    }
    close(ends[1]);
    return {pid, ends[0]};
}

[[noreturn]] void keep_busy(unsigned processor, pid_t parent)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    set_fifo(0);
    pin(processor);
    if (getppid() != parent) _exit(0);
    for (volatile unsigned turns = 0;;) turns = turns + 1;
}

void end_all(const std::vector<pid_t>& processes)
{
    for (const pid_t process : processes) kill(process, SIGKILL);
    for (const pid_t process : processes) waitpid(process, nullptr, 0);
}

net::Endpoint endpoint_in(const std::string& line)
{
    const auto begin = line.find("a=");
    const auto place =
        begin == std::string::npos
            ? base::Result<net::HostPort>{base::fail("")}
            : net::parse_host_port(line.substr(begin + 2, line.find(' ', begin) - begin - 2));
    if (!place) throw std::runtime_error{"a relay did not become ready: '" + line + "'"};
    return net::resolve(*place);
}

std::string first_line(int descriptor)
{
    std::string line;
    for (char c = 0; read(descriptor, &c, 1) == 1 && c != '\n';) line += c;
    return line;
}

} // namespace

void pin_prober() { pin(0); }

void set_real_time(bool on) { set_fifo(on ? prober_priority : 0); }

RelayProcess::RelayProcess(const std::vector<std::string>& words, Standing standing)
    : RelayProcess{start(words, standing)}
{}

RelayProcess::Started RelayProcess::start(const std::vector<std::string>& words, Standing standing)
{
    const Child child = spawn(words, [standing] {
        pin(1);
        if (standing == Standing::real_time) {
            set_fifo(relay_priority);
        } else {
            give_up_privileges();
        }
    });
    const std::string line = first_line(child.out);
    close(child.out);
    if (!line.starts_with("ready ")) {
        throw std::runtime_error{"a relay did not become ready: '" + line + "'"};
    }
    return {child.pid, line};
}

std::string output_of(const std::vector<std::string>& words)
{
    const Child child = spawn(words, [] {
        cpu_set_t all;
        CPU_ZERO(&all);
        for (long i = 0; i < sysconf(_SC_NPROCESSORS_ONLN); ++i) {
            CPU_SET(static_cast<unsigned long>(i), &all);
        }
        sched_setaffinity(0, sizeof all, &all);
    });
    std::string printed;
    std::array<char, 4096> block{};
    for (ssize_t count = 0; (count = read(child.out, block.data(), block.size())) > 0;) {
        printed.append(block.data(), static_cast<std::size_t>(count));
    }
    close(child.out);
    waitpid(child.pid, nullptr, 0);
    return printed;
}

net::Endpoint RelayProcess::a() const { return endpoint_in(ready_); }

RelayProcess::~RelayProcess()
{
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
}

base::Duration time_used_by(pid_t process)
{
    clockid_t clock{};
    timespec time{};
    if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return {};
    return std::chrono::seconds{time.tv_sec} + std::chrono::nanoseconds{time.tv_nsec};
}

BusyProcesses::BusyProcesses()
{
    const auto processors = std::max(1L, sysconf(_SC_NPROCESSORS_ONLN));
    for (unsigned i = 0; i < static_cast<unsigned>(processors); ++i) {
        const pid_t parent = getpid();
        const pid_t pid = fork();
        if (pid < 0) {
            end_all(ids_);
            throw std::system_error{errno, std::generic_category(), "fork"};
        }
        if (pid == 0) keep_busy(i, parent);
        ids_.push_back(pid);
    }
}

BusyProcesses::~BusyProcesses() { end_all(ids_); }

} // namespace hapnet::bench
