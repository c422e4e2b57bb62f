// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/runner/result_tables.hpp"

#include "proto/base/csv.hpp"
#include "proto/base/ensure.hpp"
#include "proto/disk/create.hpp"
#include "proto/disk/result_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <sys/types.h>
#include <system_error>
#include <tuple>

namespace hapnet::lab::runner {

namespace {

/// A line of a file, whose memory serves the next line.
class Line {
public:
    Line() = default;
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;
    ~Line() { std::free(text_); } // NOLINT(cppcoreguidelines-no-malloc): that of getline()

    /// Reads the next line. False: there is none, or it cannot be read.
    [[nodiscard]] bool read(std::FILE* file)
    {
        length_ = getline(&text_, &size_, file);
        return length_ > 0;
    }
    /// Without its end.
    [[nodiscard]] std::string_view text() const
    {
        return {text_, static_cast<std::size_t>(length_ - 1)};
    }

private:
    char* text_ = nullptr;
    std::size_t size_ = 0;
    ssize_t length_ = 0;
};

} // namespace

void ResultTables::add(const results::File& csv, std::span<const LeadingCell> leading)
{
    const auto parsed = base::parse_csv(csv.text, csv.path);
    base::ensure(parsed.has_value());
    Table& table = table_named(csv.path);
    const auto place_of = [&](const std::string& column) {
        const auto known = std::ranges::find(table.columns, column);
        const auto place = static_cast<std::size_t>(known - table.columns.begin());
        if (known == table.columns.end()) table.columns.push_back(column);
        return place;
    };
    std::vector<std::size_t> leading_places, places;
    for (const LeadingCell& cell : leading) leading_places.push_back(place_of(cell.column));
    for (const std::string& column : parsed->columns) places.push_back(place_of(column));
    const auto width = table.columns.size();
    if (table.widths.empty() || table.widths.back().second != width)
        table.widths.emplace_back(table.lines, width);

    std::string text;
    std::vector<std::string> cells;
    for (const base::CsvTable::Line& line : parsed->lines) {
        cells.assign(width, "");
        for (std::size_t i = 0; i < leading.size(); ++i)
            cells[leading_places[i]] = base::csv_quoted(leading[i].value);
        for (std::size_t i = 0; i < places.size(); ++i)
            cells[places[i]] = base::csv_quoted(line.cells[i]);
        text += fmt::format("{}\n", fmt::join(cells, ","));
        ++table.lines;
    }
    if (std::fwrite(text.data(), 1, text.size(), table.waiting.get()) != text.size())
        refuse(table.name);
}

std::vector<std::string> ResultTables::commit()
{
    constexpr std::size_t block = 1 << 20;
    std::vector<std::string> names;
    for (const Table& table : tables_) {
        disk::ResultFile file{(folder_ / table.name).string()};
        std::string text = fmt::format("{}\n", fmt::join(table.columns, ","));
        if (std::fseek(table.waiting.get(), 0, SEEK_SET) != 0) refuse(table.name); // flushes
        auto width = table.widths.begin();
        Line line;
        for (std::size_t number = 0; number < table.lines; ++number) {
            if (!line.read(table.waiting.get())) refuse(table.name);
            if (width + 1 != table.widths.end() && number == (width + 1)->first) ++width;
            text.append(line.text());
            text += std::string(table.columns.size() - width->second, ',') + '\n';
            if (text.size() < block) continue;
            file.append(text);
            text.clear();
        }
        file.commit(text);
        names.push_back(table.name);
    }
    return names;
}

ResultTables::Table& ResultTables::table_named(const std::string& name)
{
    const auto known = std::ranges::find(tables_, name, &Table::name);
    if (known != tables_.end()) return *known;
    return tables_.emplace_back(Table{.name = name, .waiting = wait_beside(name)});
}

ResultTables::WaitingLines ResultTables::wait_beside(const std::string& name) const
{
    const std::string path = (folder_ / name).string();
    const auto place = disk::Place::find(path);
    auto file = place ? disk::create_nameless(*place) : tl::unexpected{place.error()};
    if (!file) throw std::system_error{file.error(), "cannot write beside " + path};
    WaitingLines lines{fdopen(file->number(), "w+b")};
    if (!lines) refuse(name);
    std::ignore = file->release(); // the lines' now
    return lines;
}

void ResultTables::refuse(const std::string& name) const
{
    throw std::system_error{errno, std::generic_category(),
                            "cannot write beside " + (folder_ / name).string()};
}

} // namespace hapnet::lab::runner
