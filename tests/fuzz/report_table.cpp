// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/csv.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <string>

namespace {

using Cells = std::vector<std::string>;

void append_line(std::string& text, const Cells& cells)
{
    for (std::size_t i = 0; i < cells.size(); ++i) {
        text += i == 0 ? "\"" : ",\"";
        for (const char c : cells[i]) text += c == '"' ? std::string{"\"\""} : std::string{c};
        text += '"';
    }
    text += '\n';
}

} // namespace

/// A table that is accepted has as many cells in each line as in its header, and printed with
/// every cell in quotes it reads as the same. Errors name file and line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    const auto table = base::parse_csv(text, "a.csv");
    if (!table) {
        base::ensure(table.error().message.starts_with("a.csv:"));
        return 0;
    }
    std::string printed;
    append_line(printed, table->columns);
    for (const auto& line : table->lines) {
        base::ensure(line.cells.size() == table->columns.size());
        append_line(printed, line.cells);
    }
    const auto again = base::parse_csv(printed, "b.csv");
    base::ensure(again && again->columns == table->columns);
    base::ensure(again->lines.size() == table->lines.size());
    for (std::size_t i = 0; i < again->lines.size(); ++i) {
        base::ensure(again->lines[i].cells == table->lines[i].cells);
    }
    return 0;
}
