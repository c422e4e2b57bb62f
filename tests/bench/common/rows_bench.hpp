// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/host.hpp"
#include "tests/bench/common/options.hpp"
#include "tests/bench/common/rows.hpp"

namespace hapnet::bench {

/// Returns the machine, and keeps one of its processors for this thread as far as that is allowed.
[[nodiscard]] inline Host alone(std::string_view program)
{
    Host machine = host();
    pin(1);
    if (!set_fifo(1)) {
        net::say(program, "SCHED_FIFO is not allowed here: whatever else runs counts");
    }
    return machine;
}

/// Runs a bench on one thread that prints rows, and writes them where --json says. Returns its exit
/// code. `measure` takes whether it must end within seconds, and returns the rows.
template <typename Measure>
[[nodiscard]] int rows_main(std::string_view program, std::string_view usage,
                            std::span<char*> words, Measure measure)
{
    const auto run = [&](const Options& options) -> base::Result<int> {
        Files files{options};
        const Host machine = alone(program);
        const std::vector<Row> rows = measure(options.quick);
        fmt::print("{}", rows_table(rows));
        files.write("--json", rows_json(machine, rows));
        return 0;
    };
    return main_of({program, usage, {"--json"}}, words, run);
}

} // namespace hapnet::bench
