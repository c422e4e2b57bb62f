// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/compare_command.hpp"

#include "lab/cli/files.hpp"
#include "lab/records/text_table.hpp"
#include "lab/results/compared_rows.hpp"
#include "lab/results/table_text.hpp"
#include "lab/runner/checksums.hpp"
#include "proto/net/text_file.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab {

namespace {

/// The sessions of a folder, and the file that contains them.
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

std::string to_table(const results::Table& compared)
{
    records::TextTable table{.caption = "",
                             .unit = "medians",
                             .heads = {"sessions", "A", "B", "B - A", "from", "to", "p"}};
    for (const results::TableRow& row : rows_of(compared)) {
        const auto conditions = row.text("conditions");
        if (!conditions.empty() && conditions != results::all_conditions) continue;
        auto& line = table.rows.emplace_back();
        line.name =
            fmt::format("{} {} {}", row.text("algorithm"), row.text("task"), row.text("measure"));
        line.cells.push_back(row.text("sessions"));
        for (const char* key : {"median_a", "median_b", "difference", "ci_low", "ci_high"})
            line.cells.push_back(records::number_text(row.number(key), 4));
        line.cells.push_back(fmt::format("{:.2g}", row.number("sign_test_p").value_or(1.0)));
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
    const auto compared = results::compare_sessions({a->table, a->path}, {b->table, b->path});
    if (!compared) return tl::unexpected{compared.error()};
    if (command.csv) return csv_text(*compared);
    if (command.json)
        return nlohmann::ordered_json{{"compared", results::json_objects(*compared)}}.dump(2) +
               '\n';
    return to_table(*compared);
}

} // namespace hapnet::lab
