// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// when_quiet COMMAND...: runs a test that meets the real clock. Meanwhile a thread measures whether
// the machine keeps time. A failure counts only when it did: otherwise the command runs again.
// After the last try the test is skipped, with exit code 77 and the reason.
#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
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
/// No try begins later than this after the first.
constexpr std::int64_t last_start = 100 * second;
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

    void begin() { ticks_ = late_ = longest_ = 0; }
    [[nodiscard]] bool kept_time() const
    {
        return longest_ <= longest_max &&
               static_cast<double>(late_) <= late_max * static_cast<double>(ticks_);
    }
    [[nodiscard]] std::string words() const
    {
        const double percent =
            ticks_ > 0 ? 100.0 * static_cast<double>(late_) / static_cast<double>(ticks_) : 0.0;
        char text[128];
        std::snprintf(text, sizeof text,
                      "it stood still for up to %.1f ms, and %.1f %% of its milliseconds were late",
                      static_cast<double>(longest_) / static_cast<double>(ms), percent);
        return text;
    }

private:
    static constexpr std::int64_t longest_max = 10 * ms;
    static constexpr double late_max = 0.01; // later than 1 ms: the p99 of a valid run

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
    std::atomic<bool> is_over_{false};
    std::thread thread_;
};

/// The exit code of the command; 128 + n when signal n ended it.
int run(char** command)
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
        execvp(command[0], command);
        std::perror(command[0]);
        _exit(127);
    }
    int status = 0;
    waitpid(child, &status, 0);
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
    if (std::getenv("HAPNET_CLOCK") == nullptr) {
        execvp(words[1], words + 1);
        std::perror(words[1]);
        return 127;
    }
    const std::int64_t start = now_ns();
    Watchdog watchdog;
    for (int attempt = 1;; ++attempt) {
        watchdog.begin();
        const int code = run(words + 1);
        if (code == 0 || code == exit_skipped || watchdog.kept_time()) return code;
        const std::int64_t passed = now_ns() - start;
        std::printf(
            "when_quiet: try %d of %d failed (exit code %d) while the machine was busy: %s\n",
            attempt, tries_max, code, watchdog.words().c_str());
        std::fflush(stdout);
        if (attempt == tries_max || passed > last_start) {
            std::printf("skipped: the machine was never quiet\n  for %.0f s, and the test failed "
                        "each time\n",
                        static_cast<double>(passed) / static_cast<double>(second));
            return exit_skipped;
        }
        wait_for_a_quiet_second(watchdog);
    }
}
