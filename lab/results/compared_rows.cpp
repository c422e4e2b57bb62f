// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/compared_rows.hpp"

#include "lab/metrics/paired.hpp"
#include "lab/results/session_rows.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::results {

namespace {

/// The columns that measure a session. All other columns identify it.
constexpr std::array<std::string_view, 15> measures{"mean_mm",
                                                    "std_mm",
                                                    "max_mm",
                                                    "vibration_mm",
                                                    "stiffness_ratio",
                                                    "stiffness_error",
                                                    "slow_stiffness_error",
                                                    "force_vibration_n",
                                                    "force_above_2hz_n",
                                                    "contact_lost",
                                                    "force_step_n",
                                                    "drag_n",
                                                    "force_discrepancy",
                                                    "energy_mj",
                                                    "scored_share"};

bool is_condition(std::string_view column)
{
    return std::ranges::find(measures, column) == measures.end() && column != "tier";
}

/// The sessions of a table by the texts of their conditions.
struct Sessions {
    const Table& table;
    std::vector<std::string> conditions{}; // keys of the columns that are conditions
    std::map<std::vector<std::string>, TableRow> rows{};
    std::vector<std::vector<std::string>> order{}; // keys of `rows`, in the order of the table
};

base::Result<Sessions> sessions_in(const SessionsTable& of)
{
    Sessions sessions{of.table};
    for (const Column& column : of.table.columns)
        if (is_condition(column.key)) sessions.conditions.push_back(column.key);
    for (const char* column : {"algorithm", "task", "seed"}) {
        if (of.table.place_of(column)) continue;
        return base::fail(fmt::format("{}: there is no column '{}': compare takes the sessions "
                                      "of two folders of results",
                                      of.path, column));
    }
    for (const TableRow& row : rows_of(of.table)) {
        std::vector<std::string> key;
        for (const std::string& column : sessions.conditions) key.push_back(row.text(column));
        if (!sessions.rows.emplace(key, row).second) {
            return base::fail(fmt::format("{}: '{}' is there twice", of.path, fmt::join(key, ",")));
        }
        sessions.order.push_back(std::move(key));
    }
    return sessions;
}

std::size_t place_of(const std::vector<std::string>& columns, std::string_view column)
{
    return static_cast<std::size_t>(std::ranges::find(columns, column) - columns.begin());
}

/// Names sessions by the conditions in which they differ, except algorithm, task and seed.
class ConditionNames {
public:
    explicit ConditionNames(const Sessions& sessions) : columns_{sessions.conditions}
    {
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            std::set<std::string_view> values;
            for (const auto& key : sessions.order) values.insert(key[i]);
            const auto& column = columns_[i];
            const bool is_named = column == "algorithm" || column == "task" || column == "seed";
            if (!is_named && values.size() > 1) telling_.push_back(i);
        }
        // One word of the profile replaces several of these columns.
        const auto is_number = [&](std::size_t i) {
            return columns_[i].ends_with("_ms") || columns_[i].ends_with("_percent") ||
                   columns_[i].ends_with("of_100");
        };
        const auto network = std::ranges::find(telling_, place_of(columns_, "network"));
        if (network != telling_.end() && std::ranges::any_of(telling_, is_number))
            telling_.erase(network);
    }

    [[nodiscard]] std::string name(const std::vector<std::string>& key) const
    {
        std::vector<std::string> parts;
        for (const std::size_t i : telling_)
            parts.push_back(fmt::format("{}={}", columns_[i], key[i]));
        return fmt::format("{}", fmt::join(parts, " "));
    }

    [[nodiscard]] bool is_one() const { return telling_.empty(); }

private:
    std::vector<std::string> columns_;
    std::vector<std::size_t> telling_;
};

/// The sessions of both tables that belong to a row.
using CommonSessions = std::vector<std::pair<TableRow, TableRow>>;

/// Sessions that are compared together.
struct SessionGroup {
    std::string algorithm;
    std::string task;
    std::string conditions;
    CommonSessions pairs{};
};

/// Adds the rows of a group, but none for a measure of which neither table has numbers.
void add_rows(const SessionGroup& group, Table& table)
{
    for (const std::string_view measure : measures) {
        std::vector<double> of_a, of_b;
        for (const auto& [a, b] : group.pairs) {
            const auto x = a.number(measure), y = b.number(measure);
            if (!x || !y) continue;
            of_a.push_back(*x);
            of_b.push_back(*y);
        }
        if (of_a.empty()) continue;
        const auto test = metrics::paired_test(of_b, of_a);
        table.add(group.algorithm, group.task, group.conditions, measure, test.seeds,
                  metrics::median_of(of_a), metrics::median_of(of_b), test.median,
                  test.interval.low, test.interval.high, test.p);
    }
}

} // namespace

base::Result<Table> compare_sessions(const SessionsTable& a, const SessionsTable& b)
{
    const auto of_a = sessions_in(a);
    if (!of_a) return tl::unexpected{of_a.error()};
    const auto of_b = sessions_in(b);
    if (!of_b) return tl::unexpected{of_b.error()};
    if (of_a->conditions != of_b->conditions) {
        return base::fail(fmt::format("{} and {} name their sessions by other columns: {}; and {}",
                                      a.path, b.path, fmt::join(of_a->conditions, ", "),
                                      fmt::join(of_b->conditions, ", ")));
    }
    const auto algorithm = place_of(of_a->conditions, "algorithm");
    const auto task = place_of(of_a->conditions, "task");
    const ConditionNames names{*of_a};
    std::vector<SessionGroup> groups; // in the order of A's sessions
    const auto group_of = [&](const std::vector<std::string>& key, const std::string& conditions) {
        const auto found = std::ranges::find_if(groups, [&](const SessionGroup& group) {
            return group.algorithm == key[algorithm] && group.task == key[task] &&
                   group.conditions == conditions;
        });
        if (found != groups.end()) return &found->pairs;
        return &groups.emplace_back(SessionGroup{key[algorithm], key[task], conditions}).pairs;
    };
    for (const auto& key : of_a->order) {
        const auto other = of_b->rows.find(key);
        if (other == of_b->rows.end()) continue;
        const std::pair pair{of_a->rows.at(key), other->second};
        if (!names.is_one()) group_of(key, all_conditions)->push_back(pair);
        group_of(key, names.name(key))->push_back(pair);
    }
    if (groups.empty())
        return base::fail(fmt::format("{} and {} have no session in common", a.path, b.path));
    Table table{"compared",
                columns_in("algorithm,task,conditions,measure,sessions,median_a:4,median_b:4,"
                           "difference:4,ci_low:4,ci_high:4,sign_test_p")};
    for (const SessionGroup& group : groups) add_rows(group, table);
    return table;
}

} // namespace hapnet::lab::results
