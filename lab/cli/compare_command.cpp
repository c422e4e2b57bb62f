// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/compare_command.hpp"

#include "lab/cli/files.hpp"
#include "lab/records/text_table.hpp"
#include "lab/results/compared_rows.hpp"
#include "lab/results/table_text.hpp"
#include "lab/runner/checksums.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/net/text_file.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab {

namespace {

/// The sessions of a folder, and the file that they stand in.
struct FolderSessions {
    results::Table table;
    std::string path;
};

base::Result<FolderSessions> sessions_of(const std::string& folder)
{
    if (auto fine = runner::verify_checksums(folder); !fine) return tl::unexpected{fine.error()};
    if (auto fine = require_tables(folder, results::sessions_name); !fine)
        return tl::unexpected{fine.error()};
    const auto path = (std::filesystem::path{folder} / results::sessions_name).string();
    if (!std::filesystem::exists(path)) {
        return base::fail(fmt::format("{} has no {}: compare takes two folders of results", folder,
                                      results::sessions_name));
    }
    const auto text = net::text_of_file(path);
    if (!text) return tl::unexpected{text.error()};
    auto tables = results::read_tables(*text, path);
    if (!tables) return tl::unexpected{tables.error()};
    if (tables->empty()) return base::fail(path + ": there are no sessions");
    return FolderSessions{std::move(tables->front()), path};
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

std::string to_json(const std::vector<results::ComparedRow>& rows)
{
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const results::ComparedRow& row : rows) list.push_back(base::json_of(row));
    return nlohmann::ordered_json{{"compared", list}}.dump(2) + '\n';
}

} // namespace

base::Result<std::string> compare_folders(const CompareCommand& command)
{
    const auto a = sessions_of(command.folder_a);
    if (!a) return tl::unexpected{a.error()};
    const auto b = sessions_of(command.folder_b);
    if (!b) return tl::unexpected{b.error()};
    const auto rows = results::compare_sessions({a->table, a->path}, {b->table, b->path});
    if (!rows) return tl::unexpected{rows.error()};
    if (command.csv) return csv_text(results::table_of("compared", *rows));
    return command.json ? to_json(*rows) : to_table(*rows);
}

} // namespace hapnet::lab
