// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/table.hpp"
#include "emulator/core/delay/trace.hpp"
#include "emulator/core/loss/timed_trace.hpp"
#include "emulator/core/trace/rate_trace.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <string>
#include <tuple>

namespace {

using namespace hapnet;

void check(const base::Result<std::shared_ptr<const emulator::QuantileTable>>& table)
{
    if (!table) {
        base::ensure(table.error().message.rfind("line ", 0) == 0);
        return;
    }
    double last = (*table)->quantile(0.0);
    const double greatest = (*table)->quantile(1.0);
    const double rounding = 1e-9 * (greatest - last) + 1e-6;
    base::ensure((*table)->mean() >= last - rounding && (*table)->mean() <= greatest + rounding);
    base::ensure((*table)->sd() >= 0.0 && (*table)->sd() < 1e15);
    for (int i = 1; i <= 64; ++i) {
        const double next = (*table)->quantile(i / 64.0);
        base::ensure(next >= last);
        last = next;
    }
}

void check_rates(const std::string& text)
{
    const auto trace = emulator::parse_rate_trace(text);
    if (!trace) {
        base::ensure(trace.error().message.rfind("line ", 0) == 0);
        return;
    }
    base::ensure(trace->mean_rate() > 0.0);
    for (const bool repeats : {false, true}) {
        base::Duration from{};
        for (int i = 0; i < 16; ++i) {
            const emulator::Work work = 1504 * emulator::work_per_byte;
            const auto done = trace->finish(from, work, repeats);
            if (!done) break;
            base::ensure(done->at > from);
            base::ensure(trace->sent(from, done->at, repeats) >= work);
            base::ensure(trace->sent(from, done->at - base::Duration{1}, repeats) < work);
            from = done->at;
        }
    }
}

void check_losses(const std::string& text)
{
    const auto series = emulator::parse_loss_series(text);
    if (!series) {
        base::ensure(series.error().message.rfind("line ", 0) == 0);
        return;
    }
    for (base::Duration::rep n = 0; n < 64; ++n) {
        for (const auto way : {emulator::Interpolation::step, emulator::Interpolation::linear}) {
            const double share = series->at(base::Duration{n * n * n * 1'000'003}, way, n % 2 == 0);
            base::ensure(share >= 0.0 && share <= 1.0);
        }
    }
}

} // namespace

/// An accepted table has ascending quantiles, and delays and shares in range. At its rates, a
/// datagram leaves at the first moment with room for it. Errors name a line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    check(emulator::parse_dist(text));
    check(emulator::parse_samples(text));
    check_rates(text);
    check_losses(text);
    std::ignore = emulator::parse_columns(text);
    const auto trace = emulator::parse_delay_trace(text);
    if (!trace) {
        base::ensure(trace.error().message.rfind("line ", 0) == 0);
        return 0;
    }
    for (std::uint64_t n = 0; n < 64; ++n) {
        const base::Duration at{static_cast<base::Duration::rep>(n * n * n * 1'000'003)};
        const auto delay = (*trace)->is_by_time() ? (*trace)->at(at) : (*trace)->of(n);
        base::ensure(delay >= base::Duration{0} && delay <= base::Duration{1'000'000'000'000'000});
    }
    return 0;
}
