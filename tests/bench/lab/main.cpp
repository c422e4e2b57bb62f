// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/runner/freed_memory.hpp"
#include "tests/bench/common/rows_bench.hpp"
#include "tests/bench/lab/run_time_error.hpp"
#include "tests/bench/lab/speed.hpp"

namespace hapnet::bench {

namespace {

constexpr std::string_view program = "bench_lab";
constexpr std::string_view usage =
    "usage: bench_lab [--quick] [--json FILE] [--csv FILE]\n"
    "Plays sessions in virtual time on one processor: how many times faster than life, by task "
    "and\n"
    "algorithm; and what the figures of Table 1 are off by, against run time, for ticks of 4 to\n"
    "0.25 ms, for hands in 1 to 100 steps, and for 1 to 20 seeds. --json: the rows; --csv:\n"
    "error against run time. --quick ends within a minute.\n";

base::Result<int> measure(const Options& options)
{
    Files files{options};
    const Host machine = alone(program);
    lab::runner::keep_freed_memory(); // as hapnet-lab does

    std::vector<Row> rows = measure_speed(options.quick ? 5 : 21);
    const auto points = measure_run_time_error(options.quick);
    const auto errors = work_rows(points);
    rows.insert(rows.end(), errors.begin(), errors.end());
    fmt::print("{}", rows_table(rows));
    files.write("--json", rows_json(machine, rows));
    files.write("--csv", work_csv(points));
    return 0;
}

} // namespace

} // namespace hapnet::bench

int main(int argc, char** argv)
{
    namespace bench = hapnet::bench;
    return bench::main_of({bench::program, bench::usage, {"--json", "--csv"}},
                          {argv, static_cast<std::size_t>(argc)}, bench::measure);
}
