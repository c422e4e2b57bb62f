// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <array>
#include <csignal>
#include <cstddef>
#include <memory>

namespace hapnet::net {

/// Makes the signals of a sudden end of the program (abort() and with it std::terminate() and a
/// failed ensure(), an invalid pointer, too much real time, a file beyond its limit, ...) something
/// to wait for. The crashing thread is held for at most 20 ms, in which another thread can bring
/// the devices to a safe state. Then the program dies as it would have without this class.
/// Construct at most one, early. SIGKILL cannot be handled.
class CrashSignal {
public:
    CrashSignal();
    ~CrashSignal();
    CrashSignal(const CrashSignal&) = delete;
    CrashSignal& operator=(const CrashSignal&) = delete;

    /// Readable once the program is crashing, and from then on.
    [[nodiscard]] int descriptor() const { return dying_; }
    /// True if descriptor() is readable. For a loop that checks without waiting.
    [[nodiscard]] static bool has_come() noexcept;
    /// Reports that everything is in a safe state, so that the program may die.
    void acknowledge() const;
    /// Call this for other sudden ends of the program (ExitGuard). The descriptor becomes readable,
    /// and the caller is held like a crashing thread. Does nothing if there is no CrashSignal.
    /// Calls only functions that signal-safety(7) allows.
    static void hold_to_the_end() noexcept;

    static constexpr base::Duration patience{std::chrono::milliseconds{20}};
    // The signals that the program's own faults cause, followed by those that kill it when they are
    // sent by mistake.
    static constexpr std::array signals{SIGABRT, SIGSEGV,   SIGBUS,  SIGFPE,  SIGILL,   SIGSYS,
                                        SIGTRAP, SIGXCPU,   SIGQUIT, SIGUSR1, SIGUSR2,  SIGALRM,
                                        SIGPROF, SIGVTALRM, SIGPOLL, SIGPWR,  SIGSTKFLT};

private:
    int dying_ = -1;
    int in_order_ = -1;
};

/// A signal stack for the calling thread, on which the overflow of its own stack can be handled.
/// Each thread that may crash needs one, as long as it works.
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
