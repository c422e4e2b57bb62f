// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/crash_signal.hpp"

#include "proto/base/ensure.hpp"

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <poll.h>
#include <sys/eventfd.h>
#include <system_error>
#include <tuple>
#include <unistd.h>

namespace hapnet::net {

namespace {

constexpr std::size_t crash_stack_bytes = 65536;

/// The state that a signal handler reads. It must be global, because a handler has no argument for
/// it. It is set before the handlers are installed, which only read it.
struct HandlerState {
    std::atomic<int> dying{-1};
    std::atomic<int> in_order{-1};
    std::atomic<bool> has_come{false};
    std::array<struct sigaction, CrashSignal::signals.size()> former{};
};
HandlerState handler_state;

void add_one_to(int counter)
{
    const std::uint64_t one = 1;
    std::ignore = write(counter, &one, sizeof one);
}

/// Calls only functions that signal-safety(7) allows.
extern "C" void hapnet_on_crash(int number)
{
    for (std::size_t i = 0; i < CrashSignal::signals.size(); ++i) {
        if (CrashSignal::signals[i] == number) {
            sigaction(number, &handler_state.former[i], nullptr);
        }
    }
    CrashSignal::hold_to_the_end();
    raise(number); // delivered to the former action once this returns
}

int make_counter()
{
    const int counter = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (counter < 0) throw std::system_error{errno, std::generic_category(), "eventfd"};
    return counter;
}

} // namespace

CrashSignal::CrashSignal() : dying_{make_counter()}, in_order_{make_counter()}
{
    base::ensure(handler_state.dying.load() < 0); // only one CrashSignal at a time
    handler_state.dying = dying_;
    handler_state.in_order = in_order_;
    handler_state.has_come = false;
    struct sigaction action {};
    action.sa_handler = hapnet_on_crash;
    action.sa_flags = SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < signals.size(); ++i) {
        struct sigaction& former = handler_state.former[i];
        sigaction(signals[i], &action, &former);
        // A signal that was ignored from the start, such as SIGQUIT in the background, does not
        // kill the program.
        if (former.sa_handler == SIG_IGN) sigaction(signals[i], &former, nullptr);
    }
}

CrashSignal::~CrashSignal()
{
    for (std::size_t i = 0; i < signals.size(); ++i) {
        sigaction(signals[i], &handler_state.former[i], nullptr);
    }
    handler_state.dying = -1;
    handler_state.in_order = -1;
    close(dying_);
    close(in_order_);
}

bool CrashSignal::has_come() noexcept
{
    return handler_state.has_come.load(std::memory_order_acquire);
}

void CrashSignal::hold_to_the_end() noexcept
{
    const int dying = handler_state.dying.load(std::memory_order_relaxed);
    if (dying < 0) return;
    handler_state.has_come.store(true, std::memory_order_release);
    add_one_to(dying);
    pollfd in_order{handler_state.in_order.load(std::memory_order_relaxed), POLLIN, 0};
    constexpr auto patience_ms = std::chrono::milliseconds{20}.count();
    static_assert(CrashSignal::patience == std::chrono::milliseconds{patience_ms});
    poll(&in_order, 1, patience_ms);
}

void CrashSignal::acknowledge() const { add_one_to(in_order_); }

CrashStack::CrashStack() : bytes_{std::make_unique<std::byte[]>(crash_stack_bytes)}
{
    stack_t stack{};
    stack.ss_sp = bytes_.get();
    stack.ss_size = crash_stack_bytes;
    sigaltstack(&stack, &former_);
}

CrashStack::~CrashStack() { sigaltstack(&former_, nullptr); }

} // namespace hapnet::net
