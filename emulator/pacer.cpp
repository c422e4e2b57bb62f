// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/pacer.hpp"

#include "proto/net/clock.hpp"
#include "proto/net/wait.hpp"

#include <chrono>
#include <variant>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;

SleepPolicy::Margin margin_of(Timing timing)
{
    switch (timing) {
    case Timing::eco: return {0us, 0us};
    case Timing::precise: return {10us, 100us};
    case Timing::spin: return {200us, 200us};
    }
    return {};
}

/// Returns the limit on watching the clock. It does not apply to spin, of whose risk the user is
/// warned.
SleepPolicy::Watching watching_of(Timing timing)
{
    return timing == Timing::spin ? SleepPolicy::Watching::without_limit
                                  : SleepPolicy::Watching::within_budget;
}

} // namespace

Pacer::Pacer(Timing timing, base::TimePoint now)
    : policy_{margin_of(timing), now, watching_of(timing)}
{}

void Pacer::wait(std::span<const int> descriptors, std::optional<base::TimePoint> deadline)
{
    const auto before = net::monotonic_now();
    if (policy_.wants_usage(before)) policy_.on_usage(net::thread_processor_time(), before);
    const auto plan = policy_.plan(deadline, before);
    if (const auto* spin = std::get_if<SleepPolicy::Spin>(&plan)) {
        if (!spin->warm_up) return;
        warm_up_.run();
        policy_.on_warm_up();
        return;
    }
    bool by_datagram = false;
    if (const auto* yield = std::get_if<SleepPolicy::Yield>(&plan)) {
        net::sleep_until(yield->until);
    } else {
        by_datagram = net::wait_readable(descriptors, std::get<SleepPolicy::Sleep>(plan).until);
    }
    policy_.on_wake_up(plan, {before, net::monotonic_now(), by_datagram});
}

} // namespace hapnet::emulator
