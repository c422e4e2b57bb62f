// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/precision.hpp"

#include "tests/bench/common/host.hpp"
#include "tests/bench/common/options.hpp"

namespace hapnet::bench {

namespace {

constexpr std::string_view program = "work_precision";
constexpr std::string_view usage =
    "usage: work_precision [--quick] [--csv FILE]\n"
    "Error against cost for ticks of 4 to 0.25 ms, of Hapnet's scene, Bullet, ODE and MuJoCo.\n"
    "Without --csv the table goes to stdout.\n";

base::Result<int> measure(const Options& options)
{
    Files files{options};
    pin(0);
    if (const auto missing = missing_peers(); !missing.empty()) net::say(program, missing);
    const auto points = measure_precision(subjects(), options.quick);
    if (!files.wants("--csv")) fmt::print("{}", precision_csv(points));
    files.write("--csv", precision_csv(points));
    return 0;
}

} // namespace

} // namespace hapnet::bench

int main(int argc, char** argv)
{
    namespace bench = hapnet::bench;
    const std::span<char*> words{argv, static_cast<std::size_t>(argc)};
    return bench::main_of({bench::program, bench::usage, {"--csv"}}, words, bench::measure);
}
