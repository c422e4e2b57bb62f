// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// when_quiet COMMAND...: runs a test that meets the real clock. Meanwhile a thread measures whether
// the machine keeps time. A failure counts only when it did: otherwise the command runs again.
// After the last try the test is skipped, with exit code 77 and the reason. HAPNET_CLOCK says how
// many seconds ctest gives it; a try that takes half of them is ended, and has failed: it may wait
// for what a machine that stood still has prevented.
#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace {

constexpr int tries_max = 4;
constexpr int exit_skipped = 77;
constexpr std::int64_t ms = 1'000'000; // in nanoseconds
constexpr std::int64_t second = 1000 * ms;
constexpr int exit_ended = 124;
/// A try waits at most this long for the machine to keep time for a second.
constexpr std::int64_t patience = 10 * second;

std::int64_t now_ns()
{
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * second + now.tv_nsec;
}

/// Wakes every millisecond, at ordinary priority, and counts how late that was. The limits are
/// those of a valid run of a peer (docs/formats/statistics.md), and a longest standstill.
class Watchdog {
public:
    Watchdog() : thread_{[this] { watch(); }} {}
    ~Watchdog()
    {
        is_over_ = true;
        thread_.join();
    }
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

    void begin()
    {
        ticks_ = late_ = longest_ = 0;
        began_ = now_ns();
        waited_before_ = waited_for_a_processor();
    }
    [[nodiscard]] bool kept_time() const
    {
        return longest_ <= longest_max &&
               static_cast<double>(late_) <= late_max * static_cast<double>(ticks_) &&
               waited() <= waited_max;
    }
    [[nodiscard]] std::string words() const
    {
        const double percent =
            ticks_ > 0 ? 100.0 * static_cast<double>(late_) / static_cast<double>(ticks_) : 0.0;
        char text[256];
        std::snprintf(
            text, sizeof text,
            "it stood still for up to %.1f ms, %.1f %% of its milliseconds were late, and "
            "for %.0f %% of the time a program waited for a processor",
            static_cast<double>(longest_) / static_cast<double>(ms), percent, 100.0 * waited());
        return text;
    }

private:
    static constexpr std::int64_t longest_max = 10 * ms;
    static constexpr double late_max = 0.005; // of the ticks, missed by a whole one or more
    /// A thread that mostly sleeps is woken soon, even where other threads wait, so this measures
    /// all.
    static constexpr double waited_max = 0.5;

    /// Returns for how long some program has waited for a processor since the system's start; 0
    /// where the kernel does not report it (PSI).
    [[nodiscard]] static std::int64_t waited_for_a_processor()
    {
        std::ifstream pressure{"/proc/pressure/cpu"};
        for (std::string word; pressure >> word;) {
            if (word.starts_with("total=")) return 1000 * std::atoll(word.c_str() + 6);
        }
        return 0;
    }
    [[nodiscard]] double waited() const
    {
        return static_cast<double>(waited_for_a_processor() - waited_before_) /
               static_cast<double>(std::max<std::int64_t>(now_ns() - began_, 1));
    }

    void watch()
    {
        prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
        std::int64_t due = now_ns();
        while (!is_over_) {
            due += ms;
            const timespec until{.tv_sec = due / second, .tv_nsec = due % second};
            clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
            const std::int64_t late = now_ns() - due;
            const std::int64_t missed = late / ms; // whole ticks
            ticks_ += 1 + missed;
            late_ += missed;
            longest_ = std::max<std::int64_t>(longest_, late);
            due += missed * ms;
        }
    }

    std::atomic<std::int64_t> ticks_{0};
    std::atomic<std::int64_t> late_{0};
    std::atomic<std::int64_t> longest_{0};
    std::int64_t began_ = 0;
    std::int64_t waited_before_ = 0;
    std::atomic<bool> is_over_{false};
    std::thread thread_;
};

/// Runs the command. Returns its exit code; 128 + n when signal n ended it. After `most` it is
/// ended, with its whole process group.
int run(char** command, std::int64_t most)
{
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child < 0) {
        std::perror("when_quiet: fork");
        return 1;
    }
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != parent) _exit(1);
        setpgid(0, 0);
        execvp(command[0], command);
        std::perror(command[0]);
        _exit(127);
    }
    setpgid(child, child); // here, too: the earlier call counts
    const std::int64_t end = now_ns() + most;
    int status = 0;
    while (waitpid(child, &status, WNOHANG) == 0) {
        if (now_ns() > end) {
            kill(-child, SIGKILL);
            waitpid(child, &status, 0);
            return exit_ended;
        }
        usleep(10'000);
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void wait_for_a_quiet_second(Watchdog& watchdog)
{
    const std::int64_t end = now_ns() + patience;
    do {
        watchdog.begin();
        sleep(1);
    } while (!watchdog.kept_time() && now_ns() < end);
}

} // namespace

int main(int count, char** words)
{
    if (count < 2) {
        std::fputs("usage: when_quiet COMMAND...\n", stderr);
        return 2;
    }
    const char* const given = std::getenv("HAPNET_CLOCK");
    if (given == nullptr) {
        execvp(words[1], words + 1);
        std::perror(words[1]);
        return 127;
    }
    const std::int64_t most = std::max(std::atoi(given) - 20, 2) / 2 * second;
    const std::int64_t start = now_ns();
    Watchdog watchdog;
    for (int attempt = 1;; ++attempt) {
        watchdog.begin();
        const int code = run(words + 1, most);
        if (code == 0 || code == exit_skipped || watchdog.kept_time()) return code;
        const std::int64_t passed = now_ns() - start;
        std::printf(
            "when_quiet: try %d of %d failed (exit code %d) while the machine was busy: %s\n",
            attempt, tries_max, code, watchdog.words().c_str());
        std::fflush(stdout);
        if (attempt == tries_max || passed > most) {
            std::printf("skipped: the machine was never quiet\n  for %.0f s, and the test failed "
                        "each time\n",
                        static_cast<double>(passed) / static_cast<double>(second));
            return exit_skipped;
        }
        wait_for_a_quiet_second(watchdog);
    }
}
