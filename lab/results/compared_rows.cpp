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

/// By which a session is measured; all other columns say which session it is.
constexpr std::array<std::string_view, 13> measures{"mean_mm",
                                                    "std_mm",
                                                    "max_mm",
                                                    "vibration_mm",
                                                    "stiffness_ratio",
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

/// The sessions of a file by the cells of their conditions.
struct Sessions {
    std::vector<std::string> conditions; // columns
    std::vector<std::string> measured;   // columns
    std::map<std::vector<std::string>, std::vector<std::string>> cells{};
    std::vector<std::vector<std::string>> order{}; // of the file
};

base::Result<Sessions> read_sessions(const File& file)
{
    const auto table = base::parse_csv(file.text, file.path);
    if (!table) return tl::unexpected{table.error()};
    Sessions sessions;
    for (const std::string& column : table->columns)
        (is_condition(column) ? sessions.conditions : sessions.measured).push_back(column);
    for (const char* column : {"algorithm", "task", "seed"}) {
        if (std::ranges::find(sessions.conditions, column) != sessions.conditions.end()) continue;
        return base::fail(fmt::format("{}:1: there is no column '{}': compare takes the sessions "
                                      "of two folders of results",
                                      file.path, column));
    }
    for (const base::CsvTable::Line& line : table->lines) {
        std::vector<std::string> key, cells;
        for (std::size_t i = 0; i < table->columns.size(); ++i)
            (is_condition(table->columns[i]) ? key : cells).push_back(line.cells[i]);
        if (!sessions.cells.emplace(key, std::move(cells)).second) {
            return base::fail(
                fmt::format("{}:{}: the session is there already", file.path, line.number));
        }
        sessions.order.push_back(std::move(key));
    }
    return sessions;
}

std::size_t place_of(const std::vector<std::string>& columns, std::string_view column)
{
    return static_cast<std::size_t>(std::ranges::find(columns, column) - columns.begin());
}

/// Names sessions by what differs among them, but for algorithm, task and seed.
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
        // The profile tells in one word what these tell in several.
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

/// The sessions of both files that a row is of, by the cells that they are measured by.
using Cells = std::vector<std::string>;
using CommonSessions = std::vector<std::pair<const Cells*, const Cells*>>;

/// Nothing where neither file has numbers.
void add_rows(const ComparedRow& named, const CommonSessions& pairs, const Sessions& a,
              const Sessions& b, std::vector<ComparedRow>& rows)
{
    for (const std::string_view measure : measures) {
        const auto in_a = place_of(a.measured, measure), in_b = place_of(b.measured, measure);
        if (in_a == a.measured.size() || in_b == b.measured.size()) continue;
        std::vector<double> of_a, of_b;
        for (const auto& [cells_a, cells_b] : pairs) {
            double x = 0.0, y = 0.0;
            if (!base::read_cell((*cells_a)[in_a], x) || !base::read_cell((*cells_b)[in_b], y))
                continue;
            of_a.push_back(x);
            of_b.push_back(y);
        }
        if (of_a.empty()) continue;
        const auto test = metrics::paired_test(of_b, of_a);
        ComparedRow& row = rows.emplace_back(named);
        row.measure = measure;
        row.sessions = test.seeds;
        row.median_a = metrics::median_of(of_a);
        row.median_b = metrics::median_of(of_b);
        row.difference = test.median;
        row.ci_low = test.interval.low;
        row.ci_high = test.interval.high;
        row.sign_test_p = test.p;
    }
}

} // namespace

base::Result<std::vector<ComparedRow>> compare_sessions(const File& a, const File& b)
{
    const auto of_a = read_sessions(a);
    if (!of_a) return tl::unexpected{of_a.error()};
    const auto of_b = read_sessions(b);
    if (!of_b) return tl::unexpected{of_b.error()};
    if (of_a->conditions != of_b->conditions) {
        return base::fail(fmt::format("{} and {} name their sessions by other columns: {}; and {}",
                                      a.path, b.path, fmt::join(of_a->conditions, ", "),
                                      fmt::join(of_b->conditions, ", ")));
    }
    const auto algorithm = place_of(of_a->conditions, "algorithm");
    const auto task = place_of(of_a->conditions, "task");
    const ConditionNames names{*of_a};
    std::vector<std::pair<ComparedRow, CommonSessions>> groups; // as they come
    const auto group_of = [&](const ComparedRow& named) -> CommonSessions& {
        for (auto& [row, pairs] : groups) {
            if (row.algorithm == named.algorithm && row.task == named.task &&
                row.conditions == named.conditions) {
                return pairs;
            }
        }
        return groups.emplace_back(named, CommonSessions{}).second;
    };
    for (const auto& key : of_a->order) {
        const auto other = of_b->cells.find(key);
        if (other == of_b->cells.end()) continue;
        const std::pair pair{&of_a->cells.at(key), &other->second};
        ComparedRow named;
        named.algorithm = key[algorithm];
        named.task = key[task];
        if (!names.is_one()) {
            named.conditions = all_conditions;
            group_of(named).push_back(pair);
            named.conditions = names.name(key);
        }
        group_of(named).push_back(pair);
    }
    if (groups.empty())
        return base::fail(fmt::format("{} and {} have no session in common", a.path, b.path));
    std::vector<ComparedRow> rows;
    for (const auto& [named, pairs] : groups) add_rows(named, pairs, *of_a, *of_b, rows);
    return rows;
}

} // namespace hapnet::lab::results
