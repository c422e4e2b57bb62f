// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/stop_signal.hpp"

#include "proto/base/text.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/detached_thread.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <limits>
#include <poll.h>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <system_error>
#include <tuple>
#include <unistd.h>

namespace hapnet::net {

namespace {

[[noreturn]] void refuse(const char* what)
{
    throw std::system_error{errno, std::generic_category(), what};
}

int signals_as_descriptor()
{
    sigset_t signals{};
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    const int descriptor = signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC);
    if (descriptor < 0) refuse("signalfd");
    return descriptor;
}

/// Returns the number in the lifeline variable and removes the variable from the environment; -1 if
/// there is none.
int given_lifeline()
{
    const char* const value = std::getenv(lifeline_variable);
    const auto number = base::parse_count(value != nullptr ? value : "",
                                          std::uint64_t{std::numeric_limits<int>::max()});
    unsetenv(lifeline_variable);
    return number ? static_cast<int>(*number) : -1;
}

bool has_hung_up(int descriptor)
{
    pollfd polled{descriptor, 0, 0};
    return poll(&polled, 1, 0) > 0 && (polled.revents & POLLHUP) != 0;
}

/// Makes the kernel send SIGTERM from now on when the lifeline hangs up. Returns its descriptor,
/// which stays open as long as the process lives, and which no command of this process inherits.
/// -1: there is none.
int hold_lifeline()
{
    const int given = given_lifeline();
    if (given < 0) return -1;
    // Opens a new file description, because it has only one owner, and other processes may hold the
    // same lifeline.
    int own =
        open(fmt::format("/proc/self/fd/{}", given).c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (own < 0) own = fcntl(given, F_DUPFD_CLOEXEC, 0);
    if (own < 0) return -1; // neither way gave a descriptor
    close(given);
    fcntl(own, F_SETOWN, getpid());
    fcntl(own, F_SETSIG, SIGTERM);
    fcntl(own, F_SETFL, O_NONBLOCK | O_ASYNC);
    if (has_hung_up(own)) kill(getpid(), SIGTERM);
    return own;
}

std::string given_folder()
{
    const char* const value = std::getenv(lifeline_folder_variable);
    std::string folder = value != nullptr ? value : "";
    unsetenv(lifeline_folder_variable);
    return folder;
}

} // namespace

struct StopSignal::State {
    explicit State(Hangup means) : hangup{means}, signals{signals_as_descriptor()}
    {
        wake = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
        if (wake < 0) {
            close(signals);
            refuse("eventfd");
        }
    }
    ~State()
    {
        close(signals);
        close(wake);
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    void request()
    {
        base::Duration::rep never = 0;
        const auto now = monotonic_now().time_since_epoch().count();
        if (!requested_at.compare_exchange_strong(never, now, std::memory_order_acq_rel)) return;
        const std::uint64_t one = 1;
        std::ignore = write(wake, &one, sizeof one);
    }

    void take()
    {
        signalfd_siginfo info{};
        while (read(signals, &info, sizeof info) == static_cast<ssize_t>(sizeof info)) {
            const bool is_hangup = info.ssi_signo == static_cast<std::uint32_t>(SIGHUP);
            if (is_hangup && hangup == Hangup::reload) {
                reload.store(true, std::memory_order_release);
            } else {
                if (!is_requested()) {
                    number.store(static_cast<int>(info.ssi_signo), std::memory_order_relaxed);
                    // A signal from the kernel comes from the terminal.
                    is_of_terminal.store(info.ssi_code == SI_KERNEL, std::memory_order_relaxed);
                }
                request();
            }
        }
    }

    Hangup hangup;
    int lifeline = -1;
    std::string lifeline_folder; // "": none
    int signals;
    int wake = -1; // readable once a stop was requested in any way
    [[nodiscard]] bool is_requested() const
    {
        return requested_at.load(std::memory_order_acquire) != 0;
    }

    std::atomic<base::Duration::rep> requested_at{0}; // time on the timeline; 0: never
    std::atomic<bool> reload{false};
    std::atomic<int> number{SIGTERM}; // signal number; stored before requested_at
    std::atomic<bool> is_of_terminal{false};
};

namespace {

/// Returns the standard descriptors that are terminals. Others are -1, which poll() ignores. A
/// terminal that has already hung up returns EIO.
std::array<int, 3> terminals()
{
    std::array<int, 3> found{STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO};
    for (int& descriptor : found) {
        if (isatty(descriptor) == 0 && errno != EIO) descriptor = -1;
    }
    return found;
}

} // namespace

StopSignal::StopSignal(Hangup hangup)
{
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGTTIN, SIG_IGN);
    state_ = std::make_shared<State>(hangup);
    state_->lifeline_folder = given_folder();
    state_->lifeline = hold_lifeline();
}

StopSignal::~StopSignal()
{
    const auto& folder = state_->lifeline_folder;
    if (!folder.empty() && has_hung_up(state_->lifeline)) rmdir(folder.c_str());
}

int StopSignal::descriptor() const { return state_->signals; }

bool StopSignal::requested() const
{
    if (state_->is_requested()) return true;
    state_->take();
    return state_->is_requested();
}

base::Duration StopSignal::requested_for() const
{
    if (!requested()) return {};
    const base::TimePoint at{base::Duration{state_->requested_at.load(std::memory_order_acquire)}};
    return std::max(base::Duration{1}, monotonic_now() - at);
}

int StopSignal::number() const { return state_->number.load(std::memory_order_relaxed); }

bool StopSignal::came_to_group() const
{
    return state_->is_of_terminal.load(std::memory_order_relaxed);
}

void StopSignal::request() const { state_->request(); }

bool StopSignal::reload_requested() const
{
    state_->take();
    return state_->reload.exchange(false, std::memory_order_acq_rel);
}

void StopSignal::enforce(base::Duration patience, int code) const
{
    // The terminals are found before the thread begins, because a terminal may disappear at any
    // time.
    start_detached([state = state_, patience, code, found = terminals()] {
        const auto [in, out, error] = found;
        // No events of a terminal are requested, because poll() always reports a hangup.
        std::array<pollfd, 5> polled{{{state->wake, POLLIN, 0},
                                      {state->signals, POLLIN, 0},
                                      {in, 0, 0},
                                      {out, 0, 0},
                                      {error, 0, 0}}};
        while (!state->is_requested()) {
            if (poll(polled.data(), polled.size(), -1) < 0) continue;
            state->take();
            for (std::size_t i = 2; i < polled.size(); ++i) {
                if ((polled[i].revents & (POLLHUP | POLLERR | POLLNVAL)) == 0) continue;
                state->request();
            }
        }
        sleep_until(monotonic_now() + patience);
        _exit(code);
    });
}

} // namespace hapnet::net
