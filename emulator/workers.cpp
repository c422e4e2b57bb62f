// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/workers.hpp"

#include "emulator/pacer.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/real_time.hpp"
#include "proto/net/wake_event.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <tuple>
#include <utility>

namespace hapnet::emulator {

/// The alarm that a failed worker raises. All workers share it.
struct Workers::Alarm {
    net::WakeEvent event;
    std::atomic<bool> has_rung{false};
};

class Workers::Worker {
public:
    Worker(Part part, Timing timing, Alarm& alarm)
        : part_{std::move(part)}, alarm_{alarm}, thread_{[this, timing] { run(timing); }}
    {}

    // The functions below are for the main thread.

    void ask_to_rest() { is_asked_.store(true); }
    void wait_for_rest() { round_.lock(); }
    void end_rest()
    {
        round_.unlock();
        is_asked_.store(false);
        is_asked_.notify_all();
        wake();
    }

    void ask_to_stop()
    {
        is_over_.store(true);
        wake();
    }
    void join()
    {
        if (thread_.joinable()) thread_.join();
    }
    [[nodiscard]] const std::exception_ptr& failure() const { return failure_; }

private:
    void wake()
    {
        is_woken_.store(true);
        wake_.signal();
    }

    void run(Timing timing)
    {
        try {
            std::ignore = net::request_real_time(40, net::Locking::as_used);
            relay(timing);
        } catch (...) {
            failure_ = std::current_exception();
            alarm_.has_rung.store(true);
            alarm_.event.signal();
        }
    }

    void relay(Timing timing)
    {
        part_.descriptors.push_back(wake_.descriptor());
        Pacer pacer{timing, net::monotonic_now()};
        std::optional<base::TimePoint> deadline = net::monotonic_now();
        while (!is_over_.load()) {
            pacer.wait(part_.descriptors, deadline);
            if (is_woken_.load(std::memory_order_relaxed) && is_woken_.exchange(false)) {
                wake_.clear();
            }
            is_asked_.wait(true); // lets the main thread in between two rounds
            const std::scoped_lock round{round_};
            part_.relay();
            deadline = part_.next_deadline();
        }
    }

    Part part_;
    Alarm& alarm_;
    net::WakeEvent wake_;
    std::mutex round_; // its holder may use the data of the part
    std::atomic<bool> is_asked_{false};
    std::atomic<bool> is_woken_{false};
    std::atomic<bool> is_over_{false};
    std::exception_ptr failure_; // error of the thread, for join()
    std::thread thread_;         // last member: the thread uses the others
};

Workers::Workers(std::vector<Part> parts, Timing timing) : alarm_{std::make_unique<Alarm>()}
{
    for (Part& part : parts) {
        workers_.push_back(std::make_unique<Worker>(std::move(part), timing, *alarm_));
    }
}

Workers::~Workers() { join(); }

Workers::Rest::Rest(Workers& workers) : workers_{workers}
{
    for (const auto& worker : workers_.workers_) worker->ask_to_rest();
    for (const auto& worker : workers_.workers_) worker->wait_for_rest();
}

Workers::Rest::~Rest()
{
    for (const auto& worker : workers_.workers_) worker->end_rest();
}

int Workers::descriptor() const { return alarm_->event.descriptor(); }

bool Workers::has_failed() const { return alarm_->has_rung.load(); }

void Workers::join()
{
    for (const auto& worker : workers_) worker->ask_to_stop();
    for (const auto& worker : workers_) worker->join();
}

void Workers::stop()
{
    join();
    for (const auto& worker : workers_) {
        if (worker->failure()) std::rethrow_exception(worker->failure());
    }
}

} // namespace hapnet::emulator
