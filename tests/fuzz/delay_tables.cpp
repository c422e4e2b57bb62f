// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/table.hpp"
#include "emulator/core/delay/trace.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <string>

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

} // namespace

/// What is accepted has quantiles that ascend and delays in range; what is not names its line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    check(emulator::parse_dist(text));
    check(emulator::parse_samples(text));
    const auto trace = emulator::parse_delay_trace(text);
    if (!trace) {
        base::ensure(trace.error().message.rfind("line ", 0) == 0);
        return 0;
    }
    for (std::uint64_t n = 0; n < 64; ++n) {
        const base::Duration at{static_cast<base::Duration::rep>(n * n * n * 1'000'003)};
        const auto delay = (*trace)->at({n, 96, at});
        base::ensure(delay >= base::Duration{0} && delay <= base::Duration{1'000'000'000'000'000});
    }
    return 0;
}
