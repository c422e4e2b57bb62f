// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/emulator/machine.hpp"

#include "tests/bench/common/host.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <fcntl.h>
#include <linux/capability.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace hapnet::bench {

namespace {

constexpr int relay_priority = 40; // what hapnet-emulator asks for
constexpr int prober_priority = 30;

/// What root may do and an ordinary user may not, as far as timing goes.
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

[[noreturn]] void become(std::vector<char*>& words, Standing standing, int out)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(out, STDOUT_FILENO);
    if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(126);
    pin(1);
    if (standing == Standing::real_time) {
        set_fifo(relay_priority);
    } else {
        give_up_privileges();
    }
    execv(words.front(), words.data());
    _exit(127);
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
    if (pid == 0) become(pointers, standing, ends[1]);
    close(ends[1]);
    const std::string line = first_line(ends[0]);
    close(ends[0]);
    if (!line.starts_with("ready ")) {
        throw std::runtime_error{"a relay did not become ready: '" + line + "'"};
    }
    return {pid, line};
}

net::Endpoint RelayProcess::a() const { return endpoint_in(ready_); }

RelayProcess::~RelayProcess()
{
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
}

base::Duration RelayProcess::used() const
{
    clockid_t clock{};
    timespec time{};
    if (clock_getcpuclockid(pid_, &clock) != 0 || clock_gettime(clock, &time) != 0) return {};
    return std::chrono::seconds{time.tv_sec} + std::chrono::nanoseconds{time.tv_nsec};
}

} // namespace hapnet::bench
