// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/loop/watchdog.hpp"

#include "proto/net/clock.hpp"
#include "proto/net/real_time.hpp"
#include "proto/net/wait.hpp"

#include <array>
#include <span>
#include <tuple>

namespace hapnet::peer::loop {

namespace {

constexpr int watchdog_priority = 46;                                    // above the servo's
constexpr int last_halts = 3;                                            // a wire may lose one
constexpr base::Duration last_halts_every{std::chrono::milliseconds{2}}; // longer than a tick

} // namespace

Alarm alarm_after(base::Duration silence)
{
    if (silence > Watchdog::fault_after) return Alarm::fault;
    return silence > Watchdog::halt_after ? Alarm::halt : Alarm::none;
}

Watchdog::Watchdog(device::Device& device, const net::CrashSignal* crash)
    : device_{device}, crash_{crash}, thread_{[this] { watch(); }}
{}

Watchdog::~Watchdog()
{
    ending_.store(true, std::memory_order_release);
    thread_.join();
}

void Watchdog::watch()
{
    std::ignore = net::request_real_time(watchdog_priority);
    const std::array descriptors{crash_ != nullptr ? crash_->descriptor() : -1};
    const std::span<const int> watched{descriptors.data(), crash_ != nullptr ? 1U : 0U};
    base::TimePoint next = net::monotonic_now();
    while (!ending_.load(std::memory_order_acquire)) {
        if (net::wait_readable(watched, next)) return halt_for_good();
        next = look(net::monotonic_now());
    }
}

/// Acts on the silence so far. Returns when to look again.
base::TimePoint Watchdog::look(base::TimePoint now)
{
    const auto beat = last_beat_.load(std::memory_order_acquire);
    const base::TimePoint last{base::Duration{beat}};
    const Alarm alarm = beat == resting ? Alarm::none : alarm_after(now - last);
    if (alarm != Alarm::none) {
        // The count is increased first, so that a loop that sees it unchanged has acted before the
        // halt.
        if (alarm_ == Alarm::none) halts_.fetch_add(1, std::memory_order_acq_rel);
        device_.halt();
        if (alarm == Alarm::fault && alarm_ != Alarm::fault) {
            fault_.store(true, std::memory_order_release);
        }
    }
    alarm_ = alarm;
    if (alarm != Alarm::none) return now + halt_every;
    return (beat == resting ? now : last) + halt_after + base::Duration{1};
}

void Watchdog::halt_for_good()
{
    dying_.store(true, std::memory_order_release);
    // The loop may be in the middle of a tick. The later halts come after it.
    for (int i = 0; i < last_halts; ++i) {
        device_.halt();
        net::sleep_until(net::monotonic_now() + last_halts_every);
    }
    crash_->acknowledge();
}

} // namespace hapnet::peer::loop
