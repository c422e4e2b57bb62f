// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/ranking_table.hpp"

#include "lab/metrics/psychometric.hpp"
#include "lab/metrics/subjects.hpp"
#include "lab/results/session_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::lab::results {

namespace {

/// The order of the algorithms in one task, with one value of the axis.
struct Order {
    std::vector<std::string> algorithms;
    std::vector<std::vector<double>> values; // values of each algorithm, by seed or subject
    std::vector<double> means;
};

double average_of(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Order order_in(const std::vector<SessionRow>& sessions, const experiment::Experiment& experiment,
               std::string_view task)
{
    Order order;
    for (const experiment::NamedAlgorithm& named : experiment.algorithms) {
        metrics::SubjectMeans means;
        for (const SessionRow& row : sessions) {
            const bool is_here = row.algorithm == named.name && row.task == task;
            if (is_here && row.mean_mm) means.add(row.subject, *row.mean_mm);
        }
        if (means.count() == 0) continue;
        order.algorithms.push_back(named.name);
        order.values.push_back(means.means());
        order.means.push_back(average_of(order.values.back()));
    }
    return order;
}

/// Returns Kendall's tau-b of two lists of means of the same algorithms (Kendall, Biometrika 33,
/// 1945, 239-251). A list does not order pairs that are equal in it. nullopt: a list orders no
/// pair.
std::optional<double> tau_of(const std::vector<double>& a, const std::vector<double>& b)
{
    if (a.size() != b.size()) return std::nullopt;
    const auto sign = [](double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; };
    double sum = 0.0, told_by_a = 0.0, told_by_b = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t k = i + 1; k < a.size(); ++k) {
            const double in_a = sign(a[k] - a[i]), in_b = sign(b[k] - b[i]);
            sum += in_a * in_b;
            told_by_a += in_a * in_a;
            told_by_b += in_b * in_b;
        }
    }
    if (told_by_a * told_by_b == 0.0) return std::nullopt;
    return sum / std::sqrt(told_by_a * told_by_b);
}

/// Returns the interval of tau by resampling seeds or subjects. nullopt: there are too few, or not
/// equally many for each algorithm.
std::optional<metrics::Interval> interval_of_tau(const Order& order, const Order& reference)
{
    const std::size_t count = order.values.front().size();
    const auto has_all = [&](const std::vector<double>& values) { return values.size() == count; };
    if (count < metrics::interval_seeds_min || !std::ranges::all_of(order.values, has_all))
        return std::nullopt;
    std::vector<double> taus;
    for (const auto& weights : metrics::drawn_weights(count, count)) {
        std::vector<double> sums;
        for (const auto& values : order.values)
            sums.push_back(std::inner_product(values.begin(), values.end(), weights.begin(), 0.0));
        const auto tau = tau_of(sums, reference.means);
        if (!tau) return std::nullopt;
        taus.push_back(*tau);
    }
    return metrics::interval_of(std::move(taus), static_cast<std::uint32_t>(count));
}

std::size_t rank_of(const Order& order, std::size_t algorithm)
{
    const auto is_nearer = [&](double mean) { return mean < order.means[algorithm]; };
    return 1 + static_cast<std::size_t>(std::ranges::count_if(order.means, is_nearer));
}

std::vector<std::string> tasks_of(const std::vector<SessionRow>& sessions)
{
    std::vector<std::string> tasks;
    for (const SessionRow& row : sessions)
        if (std::ranges::find(tasks, row.task) == tasks.end()) tasks.push_back(row.task);
    return tasks;
}

} // namespace

Table ranking_table(const experiment::Axis& axis, std::span<const AxisFindings> values,
                    const metrics::Criteria& criteria)
{
    Table table{"rankings", columns_in("parameter,value,task,algorithm,sessions,subjects,mean_mm:3,"
                                       "rank,kendall_tau:3,ci_low:3,ci_high:3")};
    std::vector<std::vector<SessionRow>> sessions;
    for (const AxisFindings& at : values)
        sessions.push_back(make_session_rows(*at.experiment, criteria, at.results));
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto& people = values[i].experiment->hands.people;
        const std::size_t subjects = people ? people->subjects() : 0;
        for (const std::string& task : tasks_of(sessions[i])) {
            const Order order = order_in(sessions[i], *values[i].experiment, task);
            const Order reference = order_in(sessions.front(), *values.front().experiment, task);
            if (order.algorithms.empty()) continue;
            const bool is_same = order.algorithms == reference.algorithms;
            const auto tau = is_same ? tau_of(order.means, reference.means) : std::nullopt;
            const auto interval = tau && i > 0 ? interval_of_tau(order, reference) : std::nullopt;
            const auto end = [&](double metrics::Interval::*side) {
                return interval ? std::optional{(*interval).*side} : std::nullopt;
            };
            for (std::size_t k = 0; k < order.algorithms.size(); ++k) {
                const auto count = std::ranges::count_if(sessions[i], [&](const SessionRow& row) {
                    return row.task == task && row.algorithm == order.algorithms[k];
                });
                table.add(axis.key, values[i].value, task, order.algorithms[k],
                          static_cast<std::uint64_t>(count), subjects, order.means[k],
                          rank_of(order, k), tau, end(&metrics::Interval::low),
                          end(&metrics::Interval::high));
            }
        }
    }
    return table;
}

} // namespace hapnet::lab::results
