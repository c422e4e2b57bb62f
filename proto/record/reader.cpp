// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/record/reader.hpp"

#include "proto/record/codec.hpp"
#include "proto/record/header.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::record {

namespace {

// Far above any header; keeps a large file of another kind from being read as one line.
constexpr std::size_t header_bytes_max = 1U << 20U;

/// The header without its end of line; empty when there is no such line.
std::string read_header_line(std::istream& file)
{
    std::string line;
    for (char c{}; line.size() < header_bytes_max && file.get(c);) {
        if (c == '\n') return line;
        line += c;
    }
    return {};
}

struct Append {
    Record& record;
    void operator()(const TickRow& row) const { record.ticks.push_back(row); }
    void operator()(const MessageRow& row) const { record.messages.push_back(row); }
    void operator()(const SessionRow& row) const
    {
        record.sessions.push_back(row);
        record.ticks_before_session.push_back(record.ticks.size());
    }
};

} // namespace

base::Result<Record> read(const std::string& path)
{
    std::ifstream file{path, std::ios::binary};
    if (!file) return base::fail(fmt::format("cannot open {}: {}", path, std::strerror(errno)));

    auto config = parse_header(read_header_line(file));
    if (!config) {
        return base::fail(
            fmt::format("{} is not a record that can be read: {}", path, config.error().message));
    }
    Record record{
        .config = std::move(*config), .ticks{}, .messages{}, .sessions{}, .ticks_before_session{}};
    RowBytes bytes{};
    for (std::size_t number = 1;; ++number) {
        file.read(reinterpret_cast<char*>(bytes.data()), row_bytes);
        if (file.gcount() != static_cast<std::streamsize>(row_bytes)) break;
        const auto row = decode(bytes);
        if (!row) {
            return base::fail(
                fmt::format("{}: row {} is damaged: {}", path, number, row.error().message));
        }
        std::visit(Append{record}, *row);
    }
    if (file.bad())
        return base::fail(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
    record.cut_off = file.gcount() != 0;
    return record;
}

} // namespace hapnet::record
