// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/emulator/accuracy.hpp"

#include "proto/net/clock.hpp"
#include "tests/bench/emulator/lateness.hpp"
#include "tests/bench/emulator/machine.hpp"
#include "tests/bench/emulator/probe.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <map>
#include <optional>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

using namespace std::chrono_literals;

/// The settings of an emulated path.
struct Case {
    Standing standing = Standing::real_time;
    double rate = 1000.0;
    base::Duration delay{};

    [[nodiscard]] std::string name() const
    {
        return fmt::format("{} kpps, {} ms, {}", rate / 1000.0, delay / 1ms,
                           standing == Standing::real_time ? "real-time" : "ordinary user");
    }
};

/// The figures of one trial, microseconds.
struct Numbers {
    double p50 = 0.0;
    double p99 = 0.0;
    double p99_beside = 0.0; // of datagrams near whose departure another one arrived
    double p999 = 0.0;
    double max = 0.0;
    double min = 0.0;
    double cpu_percent = 0.0;
    double reordered = 0.0;
    double lost = 0.0;
};

Numbers numbers_of(const TimingTrial& trial, double cpu_share)
{
    return {.p50 = quantile_us(trial.errors, 0.5),
            .p99 = quantile_us(trial.errors, 0.99),
            .p99_beside = quantile_us(trial.errors_beside_arrival, 0.99),
            .p999 = quantile_us(trial.errors, 0.999),
            .max = quantile_us(trial.errors, 1.0),
            .min = quantile_us(trial.errors, 0.0),
            .cpu_percent = 100.0 * cpu_share,
            .reordered = static_cast<double>(trial.tally.reordered),
            .lost = static_cast<double>(trial.tally.sent - trial.tally.received)};
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const auto middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2.0;
}

double median_of(const std::vector<Numbers>& trials, double Numbers::*field)
{
    std::vector<double> values;
    for (const Numbers& trial : trials) values.push_back(trial.*field);
    return median(values);
}

class Comparison {
public:
    Comparison(const Plan& plan, const Case& given) : plan_{plan}, case_{given} {}

    void run_round(Prober& prober)
    {
        add("direct", prober.measure_timing(load(prober.b(), 0ns)), 0.0);
        for (const Subject& subject : subjects()) {
            const RelayProcess relay{
                command_of(subject, plan_, {prober.a(), prober.b()}, case_.delay), case_.standing};
            std::ignore = prober.measure_timing({relay.a(), case_.rate, 20ms, case_.delay});
            const auto used = relay.used();
            const auto begin = net::monotonic_now();
            const auto trial = prober.measure_timing(load(relay.a(), case_.delay));
            add(subject.name, trial,
                base::to_seconds(relay.used() - used) /
                    base::to_seconds(net::monotonic_now() - begin));
        }
    }

    [[nodiscard]] std::vector<Row> rows() const
    {
        std::vector<Row> rows = descriptive_rows("direct");
        for (const Subject& subject : subjects()) {
            const auto more = descriptive_rows(subject.name);
            rows.insert(rows.end(), more.begin(), more.end());
        }
        const auto targets = target_rows();
        rows.insert(rows.end(), targets.begin(), targets.end());
        return rows;
    }

    [[nodiscard]] std::vector<Distribution> distributions() const
    {
        std::vector<Distribution> all;
        for (const Subject& subject : subjects()) {
            all.push_back({subject.name, errors_.at(subject.name)});
            std::sort(all.back().errors.begin(), all.back().errors.end());
        }
        return all;
    }

private:
    [[nodiscard]] std::vector<Subject> subjects() const
    {
        // Only the case of 10 ms in real time compares all timing modes.
        if (case_.delay != 10ms || case_.standing == Standing::ordinary) {
            return {precise, poll_relay, timerfd_relay};
        }
        return {eco, precise, spin, poll_relay, timerfd_relay};
    }

    [[nodiscard]] Prober::Load load(const net::Endpoint& to, base::Duration delay) const
    {
        const auto full = case_.rate > 5000.0 ? 400ms : 1000ms;
        const auto quick = case_.rate > 5000.0 ? 150ms : 250ms;
        return {to, case_.rate, plan_.quick ? base::Duration{quick} : base::Duration{full}, delay};
    }

    void add(std::string_view subject, const TimingTrial& trial, double cpu_share)
    {
        numbers_[subject].push_back(numbers_of(trial, cpu_share));
        auto& errors = errors_[subject];
        errors.insert(errors.end(), trial.errors.begin(), trial.errors.end());
    }

    [[nodiscard]] double value(std::string_view subject, double Numbers::*field) const
    {
        return median_of(numbers_.at(subject), field);
    }

    [[nodiscard]] Row row(std::string_view subject, std::string_view metric, double value) const
    {
        return {.name = case_.name(),
                .subject = std::string{subject},
                .baseline = "",
                .metric = std::string{metric},
                .value = value,
                .baseline_value = std::nullopt,
                .target = std::nullopt};
    }

    [[nodiscard]] std::vector<Row> descriptive_rows(std::string_view subject) const
    {
        std::vector<Row> rows{row(subject, "p50_us", value(subject, &Numbers::p50)),
                              row(subject, "p99_us", value(subject, &Numbers::p99)),
                              row(subject, "p999_us", value(subject, &Numbers::p999)),
                              row(subject, "max_us", value(subject, &Numbers::max))};
        if (subject != "direct") {
            rows.push_back(row(subject, "cpu_percent", value(subject, &Numbers::cpu_percent)));
            rows.push_back(row(subject, "lost", value(subject, &Numbers::lost)));
        }
        for (Row& one : rows) {
            if (subject == "direct" || subject == timerfd_relay.name || one.metric == "lost")
                continue;
            one.baseline = timerfd_relay.name;
            one.baseline_value = baseline_of(one.metric);
        }
        return rows;
    }

    [[nodiscard]] double baseline_of(std::string_view metric) const
    {
        const auto field = metric == "p50_us"    ? &Numbers::p50
                           : metric == "p99_us"  ? &Numbers::p99
                           : metric == "p999_us" ? &Numbers::p999
                           : metric == "max_us"  ? &Numbers::max
                                                 : &Numbers::cpu_percent;
        return value(timerfd_relay.name, field);
    }

    /// Returns the rows with a target. Only `precise`, the default, has targets for its timing.
    [[nodiscard]] std::vector<Row> target_rows() const
    {
        std::vector<Row> rows;
        for (const Subject& subject : subjects()) {
            if (subject.timing.empty()) continue;
            Row never_early = row(subject.name, "min_us", earliest(subject.name));
            never_early.target = 0.0;
            never_early.direction = Direction::at_least;
            Row in_order = row(subject.name, "reordered", value(subject.name, &Numbers::reordered));
            in_order.target = 0.0;
            rows.insert(rows.end(), {never_early, in_order});
        }
        // Without a delay no time of departure exists, and only the wake-up counts.
        if (case_.delay == 0ns || case_.rate > 1000.0) return rows;
        Row p50 = ratio_row("p50_ratio", &Numbers::p50);
        p50.target = case_.standing == Standing::real_time ? 5.0 : 4.0;
        rows.push_back(p50);
        if (case_.standing == Standing::ordinary) return rows;
        Row beside =
            row(precise.name, "p99_beside_arrival_us", value(precise.name, &Numbers::p99_beside));
        beside.baseline = timerfd_relay.name;
        beside.baseline_value = value(timerfd_relay.name, &Numbers::p99_beside);
        rows.push_back(beside);
        Row p99 = ratio_row("p99_ratio", &Numbers::p99);
        p99.target = 2.0;
        Row cpu =
            row(precise.name, "cpu_percent_of_core", value(precise.name, &Numbers::cpu_percent));
        cpu.target = 12.0;
        const double floor = value("direct", &Numbers::p50);
        Row above =
            row(precise.name, "p50_above_direct_us", value(precise.name, &Numbers::p50) - floor);
        above.baseline = "direct";
        above.baseline_value = floor;
        above.target = 6.0;
        rows.insert(rows.end(), {p99, cpu, above});
        return rows;
    }

    [[nodiscard]] Row ratio_row(std::string_view metric, double Numbers::*field) const
    {
        Row ratio = row(precise.name, metric, value(precise.name, field));
        ratio.baseline = timerfd_relay.name;
        ratio.baseline_value = value(timerfd_relay.name, field);
        ratio.direction = Direction::at_least;
        return ratio;
    }

    [[nodiscard]] double earliest(std::string_view subject) const
    {
        double least = numbers_.at(subject).front().min;
        for (const Numbers& trial : numbers_.at(subject)) least = std::min(least, trial.min);
        return least;
    }

    Plan plan_;
    Case case_;
    std::map<std::string_view, std::vector<Numbers>> numbers_;
    std::map<std::string_view, std::vector<base::Duration>> errors_;
};

std::vector<Case> cases_of(const Plan& plan, bool fifo)
{
    std::vector<Case> cases;
    const auto add = [&](Standing standing, double rate, std::vector<base::Duration> delays) {
        for (const auto delay : delays) cases.push_back({standing, rate, delay});
    };
    const std::vector<base::Duration> all{0ms, 1ms, 10ms, 50ms, 160ms};
    if (fifo) {
        add(Standing::real_time, 1000.0, all);
        add(Standing::real_time, 10'000.0, plan.quick ? std::vector<base::Duration>{10ms} : all);
    }
    const std::vector<base::Duration> some{1ms, 10ms, 160ms};
    add(Standing::ordinary, 1000.0, plan.quick ? std::vector<base::Duration>{10ms} : some);
    return cases;
}

} // namespace

Accuracy measure_accuracy(const Plan& plan, bool fifo)
{
    const auto cases = cases_of(plan, fifo);
    std::vector<Comparison> comparisons;
    for (const Case& one : cases) comparisons.emplace_back(plan, one);
    Prober prober{Sending::ordinary};
    set_real_time(fifo);
    const int rounds = 3; // the median of three is safe against one disturbed round
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < cases.size(); ++i) {
            fmt::print(stderr, "accuracy: round {} of {}: {}\n", round + 1, rounds,
                       cases[i].name());
            comparisons[i].run_round(prober);
        }
    }
    set_real_time(false);
    Accuracy accuracy;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto rows = comparisons[i].rows();
        accuracy.rows.insert(accuracy.rows.end(), rows.begin(), rows.end());
        const bool is_plotted = cases[i].delay == 10ms && cases[i].rate <= 1000.0;
        if (is_plotted && accuracy.distributions.empty()) {
            accuracy.distributions = comparisons[i].distributions();
        }
    }
    return accuracy;
}

} // namespace hapnet::bench
