// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <array>
#include <csignal>
#include <cstddef>
#include <memory>

namespace hapnet::net {

/// The signals by which a program comes to a sudden end (abort() and with it std::terminate() and a
/// failed ensure(), a wild pointer, too much real time, a file beyond its limit, ...) as something
/// to wait for. The thread that dies is held for at most 20 ms, in which another one may leave the
/// world in order; then the program dies as it would have without. Construct at most one, early.
/// Nothing helps against SIGKILL.
class CrashSignal {
public:
    CrashSignal();
    ~CrashSignal();
    CrashSignal(const CrashSignal&) = delete;
    CrashSignal& operator=(const CrashSignal&) = delete;

    /// Readable once the program is dying, and from then on.
    [[nodiscard]] int descriptor() const { return dying_; }
    /// True if the signal's descriptor is readable, for a loop that checks without waiting.
    [[nodiscard]] static bool has_come() noexcept;
    /// Lets the program die: everything is in a safe state.
    void acknowledge() const;
    /// Call it for other sudden ends of the program (ExitGuard): the descriptor becomes readable,
    /// and the caller is held as a dying thread is. It does nothing without a CrashSignal. Calls
    /// only what signal-safety(7) allows.
    static void hold_to_the_end() noexcept;

    static constexpr base::Duration patience{std::chrono::milliseconds{20}};
    // The signals that a program dies of by itself, then those that end it when they are sent by
    // mistake.
    static constexpr std::array signals{SIGABRT, SIGSEGV,   SIGBUS,  SIGFPE,  SIGILL,   SIGSYS,
                                        SIGTRAP, SIGXCPU,   SIGQUIT, SIGUSR1, SIGUSR2,  SIGALRM,
                                        SIGPROF, SIGVTALRM, SIGPOLL, SIGPWR,  SIGSTKFLT};

private:
    int dying_ = -1;
    int in_order_ = -1;
};

/// A stack on which the calling thread can be told that its own has overflowed. One per thread that
/// may crash; lives as long as the thread works.
class CrashStack {
public:
    CrashStack();
    ~CrashStack();
    CrashStack(const CrashStack&) = delete;
    CrashStack& operator=(const CrashStack&) = delete;

private:
    std::unique_ptr<std::byte[]> bytes_;
    stack_t former_{};
};

} // namespace hapnet::net
