// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/loop/supervise.hpp"

#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/wait.hpp"

#include <array>
#include <cstdio>
#include <exception>
#include <spdlog/fmt/fmt.h>
#include <thread>

namespace hapnet::peer::loop {

namespace {

constexpr base::Duration drain_every{std::chrono::milliseconds{50}};

/// The servo on a thread of its own; an exception in it comes out of join().
class ServoThread {
public:
    explicit ServoThread(Servo& servo)
        : thread_{[this, &servo] {
              try {
                  servo.run();
              } catch (...) {
                  failure_ = std::current_exception();
                  failed_.store(true, std::memory_order_release);
              }
          }}
    {}

    [[nodiscard]] bool has_failed() const { return failed_.load(std::memory_order_acquire); }

    void join()
    {
        thread_.join();
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    std::exception_ptr failure_;
    std::atomic<bool> failed_{false};
    std::jthread thread_; // last: it uses the others
};

} // namespace

void supervise(const Supervised& supervised, const std::string& ready)
{
    const auto& [servo, monitor, stop, control_session] = supervised;
    const base::Duration every =
        control_session != nullptr ? monitor::ControlSession::every : drain_every;
    ServoThread thread{servo};
    bool is_announced = false;
    try {
        while (!servo.is_done() && !thread.has_failed()) {
            const auto now = net::monotonic_now();
            const std::array descriptors{stop.descriptor()};
            // Once a stop is asked for, the descriptor may stay readable: then only sleep.
            net::wait_readable(stop.requested() ? std::span<const int>{} : descriptors,
                               now + every);
            if (stop.requested()) servo.stop();
            if (!is_announced && servo.is_running()) {
                fmt::print("{}", ready);
                std::fflush(stdout);
                is_announced = true;
                if (const auto shortage = servo.real_time().shortage(); !shortage.empty()) {
                    net::say("hapnet-peer", shortage);
                }
            }
            if (control_session != nullptr) control_session->serve(net::monotonic_now());
            monitor.drain();
            monitor.show(net::monotonic_now());
        }
    } catch (...) {
        servo.stop(); // whatever it is: the hand comes first
        thread.join();
        throw;
    }
    thread.join();
    monitor.finish();
}

} // namespace hapnet::peer::loop
