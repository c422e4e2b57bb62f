// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/loop/supervise.hpp"

#include "proto/net/clock.hpp"
#include "proto/net/terminal_key.hpp"
#include "proto/net/wait.hpp"

#include <array>
#include <csignal>
#include <exception>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <thread>
#include <utility>

namespace hapnet::peer::loop {

namespace {

constexpr base::Duration drain_every{std::chrono::milliseconds{50}};

/// Runs the servo on a separate thread. join() rethrows its exception.
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
    std::jthread thread_; // declared last: it uses the other members
};

void announce(const Supervised& supervised, const std::string& ready)
{
    supervised.out.put(ready);
    if (supervised.manager != nullptr) supervised.manager->tell_ready();
    const auto shortage = supervised.servo.real_time().shortage();
    if (!shortage.empty()) supervised.screen.put(fmt::format("hapnet-peer: {}\n", shortage));
}

/// Handles the emergency stop, by Enter at the terminal or by a client of the control socket. It
/// also handles a stop, which is announced only to programs.
class Stops {
public:
    explicit Stops(const Supervised& supervised) : all_{supervised} {}

    void look(base::TimePoint now)
    {
        if (key_.was_pressed()) all_.gate.stop_in_emergency();
        if (!is_emergency_told_ && all_.gate.is_stopped_in_emergency()) {
            is_emergency_told_ = true;
            all_.screen.put("hapnet-peer: emergency stop: zero force until the program is started "
                            "anew; Ctrl-C ends it\n");
            all_.monitor.note({.at = now, .name = "emergency_stop"});
        }
        if (!is_stop_told_ && all_.stop.requested()) {
            is_stop_told_ = true;
            all_.monitor.note(
                {.at = now, .name = "stop", .details = {{"cause", cause_of(all_.stop)}}});
        }
    }

private:
    [[nodiscard]] static std::string_view cause_of(const net::StopSignal& stop)
    {
        const int number = stop.number();
        return number == SIGINT ? "SIGINT" : number == SIGHUP ? "SIGHUP" : "SIGTERM";
    }

    const Supervised& all_;
    net::TerminalKey key_;
    bool is_emergency_told_ = false;
    bool is_stop_told_ = false;
};

/// Sends keep-alive messages to the service manager as long as the loop makes progress.
class SignsOfLife {
public:
    SignsOfLife(const Servo& servo, net::ServiceManager* manager)
        : servo_{servo}, manager_{manager}, beat_{servo.last_beat()}
    {}

    void look(base::TimePoint now)
    {
        const base::TimePoint beat = servo_.last_beat();
        if (manager_ == nullptr || beat == beat_) return;
        beat_ = beat;
        manager_->tell_alive(now);
    }

private:
    const Servo& servo_;
    net::ServiceManager* manager_;
    base::TimePoint beat_;
};

/// Does one round of the supervising thread, which sleeps until something happens, or for a while.
void look_after(const Supervised& supervised, Stops& stops)
{
    auto& monitor = supervised.monitor;
    auto* const control_session = supervised.control_session;
    auto* const plot = supervised.plot;
    const base::Duration every = control_session != nullptr ? monitor::ControlSession::every
                                 : plot != nullptr          ? monitor::PlotStream::every
                                                            : drain_every;
    // After a stop was requested, the descriptor may stay readable, so the thread then only sleeps.
    const std::array descriptors{supervised.stop.descriptor()};
    net::wait_readable(supervised.stop.requested() ? std::span<const int>{} : descriptors,
                       net::monotonic_now() + every);
    stops.look(net::monotonic_now());
    monitor.on_sending(supervised.servo.sending());
    monitor.drain(); // first: it feeds the frames for the clients below
    if (control_session != nullptr) control_session->serve(net::monotonic_now());
    if (plot != nullptr) plot->serve(net::monotonic_now());
}

} // namespace

void supervise(const Supervised& supervised, const std::string& ready)
{
    Servo& servo = supervised.servo;
    monitor::Monitor& monitor = supervised.monitor;
    Stops stops{supervised};
    SignsOfLife signs{servo, supervised.manager};
    ServoThread thread{servo};
    bool is_announced = false;
    try {
        while (!servo.is_done() && !thread.has_failed()) {
            look_after(supervised, stops);
            if (!is_announced && servo.is_running()) {
                announce(supervised, ready);
                is_announced = true;
            }
            signs.look(net::monotonic_now());
            monitor.show(net::monotonic_now());
        }
    } catch (...) {
        supervised.stop.request(); // whatever the error is: the hand comes first
        thread.join();
        throw;
    }
    thread.join();
    if (supervised.manager != nullptr) supervised.manager->tell_stopping();
    monitor.close();
    while (!monitor.is_done() && supervised.stop.requested_for() < give_up_after) {
        look_after(supervised, stops);
    }
    monitor.finish();
}

void wait_for_readers(const net::TextQueue& text, const net::StopSignal& stop)
{
    std::uint64_t written = text.written();
    base::TimePoint progress = net::monotonic_now();
    while (!text.is_done()) {
        const auto now = net::monotonic_now();
        if (text.written() != std::exchange(written, text.written())) progress = now;
        if (stop.requested_for() >= give_up_after || now - progress >= text_patience) return;
        net::wait_readable({}, now + std::chrono::milliseconds{5});
    }
}

} // namespace hapnet::peer::loop
