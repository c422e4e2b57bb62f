// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace hapnet::e2e {

/// The fate of a daemon in the middle of a push.
enum class Trouble : std::uint8_t {
    none,
    exception,   // in the servo
    abort,       // in the servo: as a failed ensure() or std::terminate() end it
    wild_write,  // in the servo: SIGSEGV
    stack,       // of the servo's thread overflows: SIGSEGV
    hang,        // apply() does not return for 60 ms
    long_hang,   // ... for 200 ms
    late_read,   // read() does not return for 60 ms
    device_lost, // the device says that it has been unplugged
    nonsense,    // ... that it is at a place that is no number
    docked,      // ... that its stylus lies in its holder
    exit,        // in the servo: code that it calls ends the program with exit code 0
    mute,        // the device sets the pace, and stops calling
};

/// The setup of the daemon, and its fate.
struct RecordedPlay {
    Trouble trouble = Trouble::none;
    device::Pacing pacing = device::Pacing::host;
    std::string listen{};
    std::string remote{};
    std::string messages{}; // the file that its stderr goes to
    std::string control{};  // where its control socket is to be; empty: it has none
    std::string record{};   // where its record goes; empty: it writes none
    bool blocked = false;   // stdout and stderr are full pipes that nobody reads
    /// The master of a pseudo-terminal that becomes the daemon's stdin, stdout and stderr. It is
    /// full and not read. It hangs up when the test closes the master. -1: none.
    int terminal = -1;
    bool needs_button = false; // a dead man's switch, let go in the middle of a push
};

/// One command to the device, in the bytes that go through a pipe.
struct Told {
    double newtons = 0.0;
    std::int64_t at_ns = 0; // CLOCK_BOOTTIME
    bool motors_on = false;
    bool by_halt = false;
    bool is_trouble = false; // no command: the trouble begins here
};

/// A daemon of the shell's own parts in a child process, with a device that records all commands: a
/// simulated Omni in a hand that plays P1.
class RecordedPeer {
public:
    explicit RecordedPeer(const RecordedPlay& play);
    ~RecordedPeer();
    RecordedPeer(const RecordedPeer&) = delete;
    RecordedPeer& operator=(const RecordedPeer&) = delete;

    /// Waits until its hand has felt a force 200 times.
    [[nodiscard]] bool pushes();
    /// Waits, 20 s at most, until the commands so far meet the condition; false: they never did.
    template <typename Condition>
    [[nodiscard]] bool tells(Condition condition)
    {
        while (!condition(told_)) {
            if (!has_more(20'000) || !take_one()) return false;
        }
        return true;
    }
    /// Reads the commands so far. Unread, they would fill the pipe and stop the daemon.
    void take_what_is_there()
    {
        while (has_more(0) && take_one()) {}
    }
    void signal(int number) const;
    /// Sends a signal to one thread, by the order of their starts: 0 is the main thread.
    void signal_thread(std::size_t thread, int number) const;
    /// Waits for its end. Returns the exit code, or 128 + the signal that ended it.
    [[nodiscard]] int wait_end();

    [[nodiscard]] const std::vector<Told>& told() const { return told_; }

private:
    bool take_one();
    [[nodiscard]] bool has_more(int wait_ms) const;

    int pid_ = -1;
    int pipe_ = -1;
    std::vector<Told> told_;
};

} // namespace hapnet::e2e
