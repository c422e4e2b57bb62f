// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/compare_command.hpp"

#include "lab/records/text_table.hpp"
#include "lab/results/compared_rows.hpp"
#include "lab/runner/checksums.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/net/text_file.hpp"

#include <filesystem>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab {

namespace {

base::Result<results::File> sessions_of(const std::string& folder)
{
    if (auto fine = runner::verify_checksums(folder); !fine) return tl::unexpected{fine.error()};
    for (const char* name : {"sessions.csv", "sessions_by_axis.csv", "sessions_by_point.csv"}) {
        const auto path = (std::filesystem::path{folder} / name).string();
        if (!std::filesystem::exists(path)) continue;
        return net::text_of_file(path).map([&](const std::string& text) {
            return results::File{path, text};
        });
    }
    return base::fail(
        fmt::format("{} has no sessions.csv: compare takes two folders of results", folder));
}

std::string to_table(const std::vector<results::ComparedRow>& rows)
{
    records::TextTable table{.caption = "",
                             .unit = "medians",
                             .heads = {"sessions", "A", "B", "B - A", "from", "to", "p"}};
    for (const results::ComparedRow& row : rows) {
        if (!row.conditions.empty() && row.conditions != results::all_conditions) continue;
        const auto number = [](double value) { return records::number_text(value, 4); };
        const auto name = fmt::format("{} {} {}", row.algorithm, row.task, row.measure);
        table.rows.push_back({name,
                              {fmt::format("{}", row.sessions), number(row.median_a),
                               number(row.median_b), number(row.difference), number(row.ci_low),
                               number(row.ci_high), fmt::format("{:.2g}", row.sign_test_p)}});
    }
    table.remarks = {"B - A: the median of the differences, with its 95 % interval; p of a sign "
                     "test, not corrected for the number of rows. --csv and --json also have each "
                     "condition."};
    return records::to_text(table);
}

} // namespace

base::Result<std::string> compare_folders(const CompareCommand& command)
{
    const auto a = sessions_of(command.folder_a);
    if (!a) return tl::unexpected{a.error()};
    const auto b = sessions_of(command.folder_b);
    if (!b) return tl::unexpected{b.error()};
    const auto rows = results::compare_sessions(*a, *b);
    if (!rows) return tl::unexpected{rows.error()};
    if (command.csv) return base::csv_text(*rows);
    return command.json ? base::json_of(Comparison{*rows}).dump(2) + '\n' : to_table(*rows);
}

} // namespace hapnet::lab
