// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/common/rows_bench.hpp"
#include "tests/bench/secure/costs.hpp"
#include "tests/bench/secure/turns.hpp"

namespace {

constexpr std::string_view usage =
    "usage: bench_secure [--quick] [--json FILE]\n"
    "Times what keys cost one side of a session: sealing and opening a message, a turn with a key\n"
    "beside the same turn without, refusing a forged datagram, a handshake; and a turn of one of "
    "2\n"
    "to 8 peers, without keys and with. --json: the rows. --quick ends within seconds.\n";

} // namespace

int main(int argc, char** argv)
{
    namespace bench = hapnet::bench;
    return bench::rows_main("bench_secure", usage, {argv, static_cast<std::size_t>(argc)},
                            [](bool quick) {
                                auto rows = bench::measure_costs_of_keys(quick ? 20 : 500);
                                const auto turns = bench::measure_turns_of_many(quick ? 10 : 100);
                                rows.insert(rows.end(), turns.begin(), turns.end());
                                return rows;
                            });
}
