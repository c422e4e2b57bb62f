// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/common/options.hpp"
#include "tests/bench/common/stages.hpp"
#include "tests/bench/scene/crowd.hpp"
#include "tests/bench/scene/heaps.hpp"
#include "tests/bench/scene/instructions.hpp"
#include "tests/bench/scene/peers.hpp"
#include "tests/bench/scene/precision.hpp"
#include "tests/bench/scene/stress.hpp"
#include "tests/bench/scene/tumbling.hpp"

#include <cstdlib>

namespace hapnet::bench {

namespace {

constexpr std::string_view program = "bench_scene";
constexpr std::string_view usage =
    "usage: bench_scene [--quick] [--json FILE] [--markdown FILE] [--csv FILE]\n"
    "       bench_scene --spin SUBJECT locked|free STEPS\n"
    "Compares Hapnet's scene with Bullet, ODE and MuJoCo: errors against what is known, cost per\n"
    "step, and how far each can be driven. --json: the rows; --markdown: the rows as tables; "
    "--csv:\n"
    "the points of the work-precision diagram. --quick ends within a minute, and counts no\n"
    "instructions.\n"
    "--spin only runs the paper's scene: it is what Valgrind counts the instructions of.\n";

constexpr int spin_words = 5;

std::vector<Row> instructions(std::span<const Subject> all)
{
    if (std::system("valgrind --version > /dev/null 2>&1") != 0) {
        net::say(program, "no valgrind: instructions are not counted");
        return {};
    }
    return count_instructions(all);
}

base::Result<int> measure(const Options& options)
{
    Files files{options};
    const Host machine = host();
    pin(0);
    if (const auto missing = missing_peers(); !missing.empty()) net::say(program, missing);
    const std::vector<Subject> all = subjects();

    const bool wants_points = files.wants("--csv") || files.wants("--markdown");
    Stages stages{program, 5 + (options.quick ? 0 : 1) + (wants_points ? 1 : 0)};
    stages.begin("costs");
    std::vector<Row> rows = measure_costs(all, options.quick);
    stages.begin("accuracy");
    for (const Scenario& scenario : all_scenarios(options.quick)) {
        stages.detail(scenario.name);
        append(rows, judge(scenario, all, options.quick ? 0.03 : 0.2));
    }
    stages.begin("how far each can be driven");
    append(rows, measure_limits(all, options.quick));
    stages.begin("what tumbles");
    append(rows, measure_tumbling(all));
    stages.begin("heaps");
    append(rows, measure_heaps(all, options.quick));
    append(rows, compare({"every scene above", "", "guards", 0.0},
                         std::vector<Reading>{
                             {"hapnet", own_family, static_cast<double>(hapnet_guards())}}));
    if (!options.quick) {
        stages.begin("instructions");
        append(rows, instructions(all));
    }
    stages.clear();
    fmt::print("{}", rows_table(rows));
    std::fflush(stdout);
    files.write("--json", rows_json(machine, rows));
    std::vector<WorkPoint> points;
    if (wants_points) {
        stages.begin("work and precision");
        points = measure_precision(all, options.quick);
    }
    files.write("--markdown",
                markdown(rows) + "Error at 1 ms, and its order in the tick from 4 to 0.25 ms:\n\n" +
                    precision_markdown(points) + "\nMissed:\n\n" + misses(rows));
    files.write("--csv", precision_csv(points));
    if (const auto said = complaints_of_peers(); !said.empty()) net::say(program, said);
    return 0;
}

} // namespace

} // namespace hapnet::bench

int main(int argc, char** argv)
{
    namespace bench = hapnet::bench;
    const std::span<char*> words{argv, static_cast<std::size_t>(argc)};
    if (argc == bench::spin_words && std::string_view{argv[1]} == "--spin") {
        const bool is_locked = std::string_view{argv[3]} == "locked";
        return bench::spin(argv[2], is_locked, std::atoi(argv[4])) ? 0 : hapnet::net::exit_usage;
    }
    return bench::main_of({bench::program, bench::usage, {"--json", "--markdown", "--csv"}}, words,
                          bench::measure);
}
