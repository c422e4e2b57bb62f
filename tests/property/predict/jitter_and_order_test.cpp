// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/predict.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

double in_ms(base::Duration duration)
{
    return std::chrono::duration<double, std::milli>{duration}.count();
}

struct Row {
    double extra_mean_ms;
    double sd_ms;
    double reordered;
    double clumped; // gaps below 50 us
    std::uint64_t extent_max;
};

/// A jitter that never meets the bound at zero delay, as two directions with other chance each.
Row row_of(Variation jitter, Order order)
{
    Profile profile;
    profile.path.up.delay = constant(1s);
    profile.path.up.jitter = std::move(jitter);
    profile.path.up.order = order;
    const auto up = predicted(profile, {.packets = 400'000}, base::Seed{3}).up;
    return {in_ms(up.lens.delay->mean - up.lens.requested_delay->mean), in_ms(*up.lens.delay->sd),
            static_cast<double>(up.lens.reordered) / 100'000.0, *up.lens.clumped_share,
            up.lens.reorder_extent_max};
}

void print(const char* name, const Row& row)
{
    std::printf("%-30s %+.3f %.3f %.3f %.3f %lu\n", name, row.extra_mean_ms, row.sd_ms,
                row.reordered, row.clumped, row.extent_max);
}

TEST(Predict, X)
{
    const auto correlated = [](base::Duration w, base::Duration tau) {
        auto v = uniform(w);
        v.correlation_time = tau;
        return v;
    };
    for (const auto w : {1ms, 5ms, 15ms}) {
        print("free", row_of(uniform(w), Order::free));
        print("keep", row_of(uniform(w), Order::keep));
        print("sorted", row_of(uniform(w), Order::sorted));
        print("20 keep", row_of(correlated(w, 20ms), Order::keep));
        print("100 keep", row_of(correlated(w, 100ms), Order::keep));
    }
    print("exp 5", row_of({ExponentialLaw{5ms}, {}}, Order::keep));
}

} // namespace
} // namespace hapnet::emulator
