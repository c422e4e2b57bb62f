// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/transport/polled_device.hpp"

#include "device/polled/gate.hpp"
#include "device/polled/reader.hpp"
#include "device/triple_buffer.hpp"
#include "proto/net/clock.hpp"

#include <atomic>
#include <chrono>
#include <semaphore>
#include <thread>
#include <tuple>
#include <utility>

namespace hapnet::device {

namespace {

constexpr std::chrono::microseconds period{500};
constexpr int silent_exchanges = 3;

} // namespace

/// The data that the thread and the device share. The thread holds a reference, as it may outlive
/// the device.
struct PolledDevice::Shared {
    explicit Shared(std::unique_ptr<polled::Exchange> its_exchange)
        : exchange{std::move(its_exchange)}
    {}

    void run()
    {
        while (!is_closing.load(std::memory_order_acquire)) {
            const base::TimePoint now = net::monotonic_now();
            const bool is_new = commands.take();
            const bool is_halted = halted.load(std::memory_order_acquire);
            hear(gate.pass(is_halted ? polled::Command{} : commands.value(), is_new, now));
            net::sleep_until(now + period);
        }
        for (int i = 0; i < silent_exchanges; ++i) hear({});
        exchange.reset(); // before done: the destructor's caller may open the device again
        done.release();
    }

    void hear(const polled::Command& command)
    {
        auto report = gate.heard(exchange->tell(command), net::monotonic_now());
        if (!report) return;
        report->cycle = ++cycles;
        reports.put(*report);
    }

    std::unique_ptr<polled::Exchange> exchange;
    polled::Gate gate;
    std::uint64_t cycles = 0;
    TripleBuffer<polled::Report> reports;
    TripleBuffer<polled::Command> commands;
    std::atomic<bool> halted{false};
    std::atomic<bool> is_closing{false};
    std::binary_semaphore done{0};
};

/// The data of the device's own thread.
struct PolledDevice::Own {
    Identity identity;
    Capabilities capabilities;
    polled::Reader reader{};
};

PolledDevice::PolledDevice(std::unique_ptr<polled::Exchange> exchange, Identity identity,
                           const Capabilities& capabilities)
    : shared_{std::make_shared<Shared>(std::move(exchange))},
      own_{std::make_unique<Own>(Own{std::move(identity), capabilities})}
{
    std::thread{[shared = shared_] { shared->run(); }}.detach();
}

PolledDevice::~PolledDevice()
{
    shared_->is_closing.store(true, std::memory_order_release);
    std::ignore = shared_->done.try_acquire_for(close_max);
}

const Identity& PolledDevice::identity() const { return own_->identity; }

const Capabilities& PolledDevice::capabilities() const { return own_->capabilities; }

CalibrationStep PolledDevice::calibrate(base::TimePoint /*now*/)
{
    shared_->reports.take();
    return shared_->reports.value().calibrated ? CalibrationStep::done
                                               : CalibrationStep::dock_stylus;
}

Sample PolledDevice::read(base::TimePoint now)
{
    shared_->reports.take();
    return own_->reader.read(shared_->reports.value(), now);
}

void PolledDevice::apply(const GovernedForce& force)
{
    // This comes first, because a command from before the halt must not be sent in a later
    // exchange.
    shared_->commands.put({force.force(), force.motors_on()});
    shared_->halted.store(false, std::memory_order_release);
}

void PolledDevice::halt() noexcept { shared_->halted.store(true, std::memory_order_release); }

} // namespace hapnet::device
