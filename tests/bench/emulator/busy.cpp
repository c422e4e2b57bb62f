// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/emulator/busy.hpp"

#include "proto/net/clock.hpp"
#include "tests/bench/emulator/busy_rows.hpp"
#include "tests/bench/emulator/machine.hpp"
#include "tests/bench/emulator/probe.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <map>
#include <spdlog/fmt/fmt.h>
#include <tuple>

namespace hapnet::bench {

namespace {

using namespace std::chrono_literals;

constexpr base::Duration delay = 50ms;
constexpr std::array rates{1000.0, 10'000.0, 20'000.0, 50'000.0};

/// A trial is longer than the second in which the kernel counts how long a thread has run.
struct Turns {
    int count;
    base::Duration each;
};

/// The result of one turn of a relay.
struct Turn {
    double rate;
    base::Duration duration;
    Standing standing;
};

void take_turn(const Plan& plan, const Subject& subject, const Turn& turn, BesideBusy& into)
{
    Prober prober{Sending::ordinary};
    const RelayProcess relay{command_of(subject, plan, {prober.a(), prober.b()}, delay),
                             turn.standing};
    std::ignore = prober.measure_timing({relay.a(), turn.rate, 100ms, delay});
    const auto used = relay.used();
    const auto begin = net::monotonic_now();
    into.add(prober.measure_timing({relay.a(), turn.rate, turn.duration, delay}));
    into.used += relay.used() - used;
    into.took += net::monotonic_now() - begin;
}

} // namespace

std::vector<Row> measure_beside_busy(const Plan& plan, bool fifo)
{
    const Turns turns = plan.quick ? Turns{2, 1500ms} : Turns{12, 5s};
    std::map<double, std::map<std::string_view, BesideBusy>> found;
    const BusyProcesses busy;
    const auto standing = fifo ? Standing::real_time : Standing::ordinary;
    set_real_time(fifo);
    for (int turn = 0; turn < turns.count; ++turn) {
        for (const double rate : rates) {
            fmt::print(stderr, "beside busy processes: turn {} of {}: {} kpps\n", turn + 1,
                       turns.count, rate / 1000.0);
            for (const Subject& subject : {eco, precise, timerfd_relay}) {
                take_turn(plan, subject, {rate, turns.each, standing}, found[rate][subject.name]);
            }
        }
    }
    set_real_time(false);
    std::vector<Row> rows;
    for (auto& [rate, relays] : found) append(rows, rows_beside_busy(rate, relays, fifo));
    return rows;
}

} // namespace hapnet::bench
