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

// A limit far above the length of any header, so that a large file of another kind is not read as
// one line.
constexpr std::size_t header_bytes_max = 1U << 20U;

/// Returns the header without its line end; empty if there is no such line.
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
    void operator()(const BodyRow& row) const { record.bodies.push_back(row); }
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

    auto header = parse_header(read_header_line(file));
    if (!header) {
        return base::fail(
            fmt::format("{} is not a record that can be read: {}", path, header.error().message));
    }
    const Layout layout = header->layout;
    Record record{.config = std::move(header->config),
                  .ticks{},
                  .messages{},
                  .sessions{},
                  .ticks_before_session{}};
    RowBytes bytes;
    for (std::size_t number = 1;; ++number) {
        char kind{};
        if (!file.get(kind)) break;
        // One byte is enough to report an unknown kind.
        bytes.assign(layout.bytes_of(std::byte(kind)).value_or(1), std::byte(kind));
        const auto rest = static_cast<std::streamsize>(bytes.size()) - 1;
        file.read(reinterpret_cast<char*>(bytes.data() + 1), rest);
        if (file.gcount() != rest) {
            record.cut_off = true;
            break;
        }
        const auto row = decode(bytes, layout);
        if (!row) {
            return base::fail(
                fmt::format("{}: row {} is damaged: {}", path, number, row.error().message));
        }
        const auto* body = std::get_if<BodyRow>(&*row);
        if (body != nullptr && !record.bodies.empty() && body->tick < record.bodies.back().tick) {
            return base::fail(fmt::format("{}: row {} is damaged: a body row of tick {} after one "
                                          "of tick {}",
                                          path, number, body->tick, record.bodies.back().tick));
        }
        std::visit(Append{record}, *row);
    }
    if (file.bad())
        return base::fail(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
    return record;
}

} // namespace hapnet::record
