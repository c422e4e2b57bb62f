// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/common/host.hpp"
#include "tests/bench/common/options.hpp"
#include "tests/bench/secure/costs.hpp"

namespace hapnet::bench {

namespace {

constexpr std::string_view program = "bench_secure";
constexpr std::string_view usage =
    "usage: bench_secure [--quick] [--json FILE]\n"
    "Times what keys cost one side of a session: sealing and opening a message, a turn with a key\n"
    "beside the same turn without, refusing a forged datagram, a handshake. --json: the rows.\n"
    "--quick ends within seconds.\n";

base::Result<int> measure(const Options& options)
{
    Files files{options};
    const Host machine = host();
    pin(1);
    if (!set_fifo(1)) {
        net::say(program, "SCHED_FIFO is not allowed here: whatever else runs counts");
    }
    const std::vector<Row> rows = measure_costs_of_keys(options.quick ? 20 : 500);
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
