// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/common/host.hpp"
#include "tests/bench/common/options.hpp"
#include "tests/bench/device/overhead.hpp"

namespace hapnet::bench {

namespace {

constexpr std::string_view program = "bench_device";
constexpr std::string_view usage =
    "usage: bench_device [--quick] [--json FILE]\n"
    "Times a tick of the servo between the device's bytes and the network's: encoder counts to a\n"
    "place, the contact, the governor with the torques of the joints. Beside it the same tick\n"
    "without governor and kinematics. --json: the rows. --quick ends within seconds.\n";

base::Result<int> measure(const Options& options)
{
    Files files{options};
    const Host machine = host();
    pin(1);
    if (!set_fifo(1)) {
        net::say(program, "SCHED_FIFO is not allowed here: whatever else runs counts");
    }
    const std::vector<Row> rows = measure_overhead(options.quick ? 50 : 1000);
    fmt::print("{}", rows_table(rows));
    files.write("--json", rows_json(machine, rows));
    return 0;
}

} // namespace

} // namespace hapnet::bench

int main(int argc, char** argv)
{
    namespace bench = hapnet::bench;
    return bench::main_of({bench::program, bench::usage, {"--json"}},
                          {argv, static_cast<std::size_t>(argc)}, bench::measure);
}
