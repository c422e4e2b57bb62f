// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/runner/result_tables.hpp"

#include "lab/results/table_text.hpp"
#include "proto/disk/create.hpp"
#include "proto/disk/result_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <string_view>
#include <sys/types.h>
#include <system_error>
#include <tuple>

namespace hapnet::lab::runner {

namespace {

/// A line of a file. Its memory is used again for the next line.
class Line {
public:
    Line() = default;
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;
    ~Line() { std::free(text_); } // NOLINT(cppcoreguidelines-no-malloc): that of getline()

    /// Reads the next line. Returns false if there is none, or if it cannot be read.
    [[nodiscard]] bool read(std::FILE* file)
    {
        length_ = getline(&text_, &size_, file);
        return length_ > 0;
    }
    /// Returns the line without its end.
    [[nodiscard]] std::string_view text() const
    {
        return {text_, static_cast<std::size_t>(length_ - 1)};
    }

private:
    char* text_ = nullptr;
    std::size_t size_ = 0;
    ssize_t length_ = 0;
};

/// A file of results that is written in blocks.
class BlockFile {
public:
    explicit BlockFile(const std::filesystem::path& path) : file_{path.string()} {}

    void add(std::string_view text)
    {
        constexpr std::size_t block = 1 << 20;
        text_ += text;
        if (text_.size() < block) return;
        file_.append(text_);
        text_.clear();
    }
    void commit() { file_.commit(text_); }

private:
    disk::ResultFile file_;
    std::string text_;
};

} // namespace

void ResultTables::add(const results::Table& part)
{
    Table& table = table_named(part.name);
    results::Table lines{part.name, table.columns};
    append(lines, part);
    table.columns = lines.columns;
    const auto width = table.columns.size();
    if (table.widths.empty() || table.widths.back().second != width)
        table.widths.emplace_back(table.rows, width);
    std::string csv, json;
    for (std::size_t row = 0; row < lines.rows.size(); ++row, ++table.rows) {
        csv += csv_line(lines, row) + '\n';
        json += json_line(lines, row) + '\n';
    }
    wait(table.csv, csv, table.name);
    wait(table.json, json, table.name);
}

std::vector<std::string> ResultTables::commit()
{
    std::vector<std::string> names;
    for (const Table& table : tables_) {
        commit_csv(table);
        names.push_back(table.name + ".csv");
    }
    for (const auto& [name, of_sessions] :
         {std::pair{results::tables_name, false}, {results::sessions_name, true}}) {
        if (commit_json(name, of_sessions)) names.emplace_back(name);
    }
    return names;
}

void ResultTables::commit_csv(const Table& table) const
{
    BlockFile file{folder_ / (table.name + ".csv")};
    file.add(results::csv_header(table.columns) + '\n');
    for_each_line(table, table.csv, [&](std::string_view line, Columns missing) {
        file.add(line);
        const auto commas = std::ranges::count_if(missing, [](const results::Column& column) {
            return column.stands != results::Stands::in_json;
        });
        file.add(std::string(static_cast<std::size_t>(commas), ',') + '\n');
    });
    file.commit();
}

bool ResultTables::commit_json(const char* name, bool of_sessions) const
{
    const auto is_meant = [&](const Table& table) {
        return table.name.starts_with("sessions") == of_sessions;
    };
    if (of_sessions && std::ranges::none_of(tables_, is_meant)) return false;
    BlockFile file{folder_ / name};
    file.add(results::json_begin);
    std::string_view between_tables;
    for (const Table& table : tables_) {
        if (!is_meant(table)) continue;
        file.add(std::exchange(between_tables, ","));
        file.add(results::json_head(table.name, table.columns));
        std::string_view between_rows = "\n[";
        for_each_line(table, table.json, [&](std::string_view line, Columns missing) {
            file.add(std::exchange(between_rows, ",\n["));
            file.add(line);
            for (std::size_t i = 0; i < missing.size(); ++i) file.add(",null");
            file.add("]");
        });
        file.add("]}");
    }
    file.add(results::json_end);
    file.commit();
    return true;
}

void ResultTables::for_each_line(const Table& table, const WaitingLines& lines,
                                 const TakeLine& take) const
{
    if (std::fseek(lines.get(), 0, SEEK_SET) != 0) refuse(table.name); // also flushes
    auto width = table.widths.begin();
    Line line;
    for (std::size_t row = 0; row < table.rows; ++row) {
        if (!line.read(lines.get())) refuse(table.name);
        if (width + 1 != table.widths.end() && row == (width + 1)->first) ++width;
        take(line.text(), Columns{table.columns}.subspan(width->second));
    }
}

void ResultTables::wait(const WaitingLines& lines, const std::string& text,
                        const std::string& name) const
{
    if (std::fwrite(text.data(), 1, text.size(), lines.get()) != text.size()) refuse(name);
}

ResultTables::Table& ResultTables::table_named(const std::string& name)
{
    const auto known = std::ranges::find(tables_, name, &Table::name);
    if (known != tables_.end()) return *known;
    return tables_.emplace_back(
        Table{.name = name, .csv = wait_beside(name), .json = wait_beside(name)});
}

ResultTables::WaitingLines ResultTables::wait_beside(const std::string& name) const
{
    const std::string path = (folder_ / name).string();
    std::filesystem::create_directories(std::filesystem::path{path}.parent_path());
    const auto place = disk::Place::find(path);
    auto file = place ? disk::create_nameless(*place) : tl::unexpected{place.error()};
    if (!file) throw std::system_error{file.error(), "cannot write beside " + path};
    WaitingLines lines{fdopen(file->number(), "w+b")};
    if (!lines) refuse(name);
    std::ignore = file->release(); // `lines` owns the descriptor now
    return lines;
}

void ResultTables::refuse(const std::string& name) const
{
    throw std::system_error{errno, std::generic_category(),
                            "cannot write beside " + (folder_ / name).string()};
}

} // namespace hapnet::lab::runner
