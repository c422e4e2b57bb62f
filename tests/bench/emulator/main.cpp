// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/text.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "tests/bench/common/host.hpp"
#include "tests/bench/common/rows.hpp"
#include "tests/bench/emulator/accuracy.hpp"
#include "tests/bench/emulator/baseline_relay.hpp"
#include "tests/bench/emulator/between.hpp"
#include "tests/bench/emulator/busy.hpp"
#include "tests/bench/emulator/capacity.hpp"
#include "tests/bench/emulator/machine.hpp"
#include "tests/bench/emulator/scale.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <span>

namespace hapnet::bench {

namespace {

constexpr std::string_view program = "bench_emulator";
constexpr std::string_view usage =
    "usage: bench_emulator [--quick] [--json FILE] [--csv FILE]\n"
    "       bench_emulator --busy [--quick] [--json FILE]\n"
    "       bench_emulator --relay poll|timerfd --a HOST:PORT --b HOST:PORT --delay 10ms\n"
    "Compares hapnet-emulator (beside this program) with two baseline relays, and writes a table.\n"
    "--csv: what share of the datagrams was at most so late, for each.\n"
    "--busy: with the timerfd relay, while a process on each processor never sleeps.\n"
    "With --relay it is one of the baselines.\n";

struct Options {
    Plan plan;
    bool beside_busy = false;
    std::optional<std::string> json;
    std::optional<std::string> csv;
    std::optional<BaselineOptions> baseline;
};

base::Result<net::Endpoint> endpoint_of(const std::string& text)
{
    const auto place = net::parse_host_port(text);
    if (!place) return tl::unexpected{place.error()};
    return net::resolve(*place);
}

base::Result<BaselineOptions> baseline_of(const std::map<std::string, std::string>& given)
{
    for (const char* name : {"--relay", "--a", "--b", "--delay"}) {
        if (!given.contains(name)) return base::fail(fmt::format("{} is missing\n{}", name, usage));
    }
    const auto a = endpoint_of(given.at("--a"));
    const auto b = endpoint_of(given.at("--b"));
    const auto delay = base::parse_duration(given.at("--delay"));
    const bool is_poll = given.at("--relay") == "poll";
    if (!a || !b || !delay || (!is_poll && given.at("--relay") != "timerfd")) {
        return base::fail(std::string{usage});
    }
    return BaselineOptions{is_poll ? Waiting::poll : Waiting::timerfd, *a, *b, *delay};
}

net::CommandLine<Options> parse(std::span<char*> words)
{
    Options options;
    std::map<std::string, std::string> given;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string word = words[i];
        if (word == "--help") return net::Answer{std::string{usage}};
        if (word == "--quick") {
            options.plan.quick = true;
            continue;
        }
        if (word == "--busy") {
            options.beside_busy = true;
            continue;
        }
        constexpr std::array known{"--json", "--csv", "--relay", "--a", "--b", "--delay"};
        if (std::find(known.begin(), known.end(), word) == known.end() || i + 1 == words.size()) {
            return base::fail(fmt::format("'{}' is not understood\n{}", word, usage));
        }
        given[word] = words[++i];
    }
    if (given.contains("--relay")) {
        const auto baseline = baseline_of(given);
        if (!baseline) return tl::unexpected{baseline.error()};
        options.baseline = *baseline;
    }
    if (given.contains("--json")) options.json = given["--json"];
    if (given.contains("--csv")) options.csv = given["--csv"];
    if (options.beside_busy && (options.csv || options.baseline)) {
        return base::fail(fmt::format("--busy goes with --quick and --json alone\n{}", usage));
    }
    const auto self = std::filesystem::read_symlink("/proc/self/exe");
    options.plan.self = self.string();
    options.plan.emulator = (self.parent_path() / "hapnet-emulator").string();
    return options;
}

/// Returns, by lateness, the share of datagrams that were at most that late.
std::string csv_of(const Accuracy& accuracy)
{
    constexpr int steps = 400;
    constexpr double error_us_max = 200.0;
    std::string csv = "subject,later_us,share_percent\n";
    for (const Distribution& one : accuracy.distributions) {
        for (int i = 0; i <= steps; ++i) {
            const double limit_us = error_us_max * i / steps;
            const auto below = std::upper_bound(one.errors.begin(), one.errors.end(),
                                                base::from_seconds(limit_us * 1e-6));
            csv += fmt::format("{},{},{:.4g}\n", one.subject, limit_us,
                               100.0 * static_cast<double>(below - one.errors.begin()) /
                                   static_cast<double>(one.errors.size()));
        }
    }
    return csv;
}

/// The rows of a bench, and its distributions if it has some.
struct Measured {
    std::vector<Row> rows;
    std::string csv;
};

Measured measure(const Options& options, bool fifo)
{
    if (options.beside_busy) return {measure_beside_busy(options.plan, fifo), ""};
    Accuracy accuracy = measure_accuracy(options.plan, fifo);
    Measured measured{std::move(accuracy.rows), csv_of(accuracy)};
    append(measured.rows, measure_capacity(options.plan, fifo));
    append(measured.rows, measure_scale(options.plan, fifo));
    append(measured.rows, measure_between(options.plan));
    return measured;
}

/// The time that the whole bench took, with its limit.
Row duration_row(const Options& options, base::Duration took)
{
    const double full_s_max = options.beside_busy ? 900.0 : 300.0;
    return {.name = options.beside_busy ? "all beside busy processes" : "all of the bench",
            .subject = "bench_emulator",
            .baseline = "",
            .metric = "duration_s",
            .value = base::to_seconds(took),
            .baseline_value = std::nullopt,
            .target = options.plan.quick ? 60.0 : full_s_max};
}

base::Result<int> run(const Options& options)
{
    if (options.baseline) run_baseline(*options.baseline);
    std::optional<disk::ResultFile> json;
    std::optional<disk::ResultFile> csv;
    if (options.json) json.emplace(*options.json, "--json");
    if (options.csv) csv.emplace(*options.csv, "--csv");
    pin_prober();
    const Host machine = host();
    if (!machine.fifo) {
        net::say(program, options.beside_busy
                              ? "SCHED_FIFO is not allowed here: nothing is judged"
                              : "SCHED_FIFO is not allowed here: only the ordinary user's part is "
                                "measured");
    }
    const auto begin = net::monotonic_now();
    Measured measured = measure(options, machine.fifo);
    measured.rows.push_back(duration_row(options, net::monotonic_now() - begin));
    fmt::print("{}", rows_table(measured.rows));
    if (json) json->commit(rows_json(machine, measured.rows));
    if (csv) csv->commit(measured.csv);
    return 0;
}

} // namespace

} // namespace hapnet::bench

int main(int argc, char** argv)
{
    namespace bench = hapnet::bench;
    const std::span<char*> words{argv, static_cast<std::size_t>(argc)};
    return hapnet::net::run_program(bench::program, bench::parse(words), bench::run);
}
