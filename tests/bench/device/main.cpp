// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/common/rows_bench.hpp"
#include "tests/bench/device/overhead.hpp"

namespace {

constexpr std::string_view usage =
    "usage: bench_device [--quick] [--json FILE]\n"
    "Times a tick of the servo between the device's bytes and the network's: encoder counts to a\n"
    "place, the contact, the governor with the torques of the joints. Beside it the same tick\n"
    "without governor and kinematics. --json: the rows. --quick ends within seconds.\n";

} // namespace

int main(int argc, char** argv)
{
    namespace bench = hapnet::bench;
    return bench::rows_main("bench_device", usage, {argv, static_cast<std::size_t>(argc)},
                            [](bool quick) { return bench::measure_overhead(quick ? 50 : 1000); });
}
