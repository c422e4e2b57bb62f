// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// A whole session in virtual time: two simulated hands at task T1 under a delay of 80 ms, and how
// far the two copies of the cube were apart.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <hapnet/emulator/core/profile/text.hpp>
#include <hapnet/lab/virtual_time/play.hpp>

int main(int argc, char** argv)
{
    using namespace hapnet;
    lab::virtual_time::Setting setting;
    setting.task = device::Task::t1;
    setting.length = std::chrono::seconds{10};
    setting.profile = emulator::parse_profile("both.delay = \"80ms\"", "here", {}).value();
    const auto algorithm = peer::algorithm_named(argc > 1 ? argv[1] : "base");
    if (!algorithm) return std::fprintf(stderr, "%s\n", algorithm.error().message.c_str()), 2;
    for (auto& player : setting.players) player.algorithm = *algorithm;
    const auto trace = lab::virtual_time::play(setting).value();
    double sum_mm = 0.0, most_mm = 0.0;
    const auto &a = trace.sides[0], &b = trace.sides[1];
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double apart_mm = 1e3 * std::abs(a[i].body.x() - b[i].body.x());
        sum_mm += apart_mm;
        most_mm = std::max(most_mm, apart_mm);
    }
    std::printf("%s: %zu ticks, |x_A - x_B| %.3f mm on average, %.3f mm at most\n",
                name_of(*algorithm).data(), a.size(), sum_mm / static_cast<double>(a.size()),
                most_mm);
    return a.empty() ? 1 : 0;
}
