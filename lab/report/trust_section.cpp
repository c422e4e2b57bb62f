// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

namespace {

/// A way of measuring: the order of the filter and whose hands.
struct MeasuringMethod {
    std::uint32_t filter_order = 0;
    std::string hand;

    friend bool operator==(const MeasuringMethod&, const MeasuringMethod&) = default;
};

MeasuringMethod method_of(const results::SensitivityRow& row)
{
    return {row.filter_order, row.hand};
}

const results::SensitivityRow* row_of(const std::vector<results::SensitivityRow>& rows,
                                      const results::SensitivityRow& like,
                                      const MeasuringMethod& method)
{
    for (const results::SensitivityRow& row : rows) {
        if (row.algorithm == like.algorithm && row.task == like.task && method_of(row) == method) {
            return &row;
        }
    }
    return nullptr;
}

Json ways_table(const std::vector<results::SensitivityRow>& rows)
{
    const std::string caption =
        fmt::format("Limit of {}, {}, by the order of the 20 Hz filter and the hands",
                    impairment_text(rows.front().impairment), unit_text(rows.front().unit));
    page::Table table{caption, {"algorithm", "task", "from … to"}};
    const auto methods = distinct(rows, method_of);
    for (const MeasuringMethod& method : methods) {
        table.heads.push_back(fmt::format("order {}\n{}", plain(method.filter_order), method.hand));
    }
    std::vector<std::pair<std::string, std::string>> seen;
    for (const results::SensitivityRow& like : rows) {
        const std::pair key{like.algorithm, like.task};
        if (std::find(seen.begin(), seen.end(), key) != seen.end()) continue;
        seen.push_back(key);
        std::vector<page::Cell> cells;
        page::Range range;
        bool is_open = false;
        for (const MeasuringMethod& method : methods) {
            const results::SensitivityRow* row = row_of(rows, like, method);
            cells.push_back({row == nullptr ? "–"
                                            : (row->is_open() ? "> " : "") +
                                                  shown(row->limit, row->limit < 20.0 ? 1 : 0)});
            if (row == nullptr) continue;
            range.include(row->limit);
            is_open |= row->is_open() && row->limit >= range.high;
        }
        const auto span = fmt::format("{} … {}{}", shown(range.low, 1), is_open ? "> " : "",
                                      shown(range.high, 1));
        cells.insert(cells.begin(), {{like.algorithm}, {like.task, "name"}, {span, "ours"}});
        table.rows.push_back(std::move(cells));
    }
    return json_of(table);
}

/// The least limit over the tasks.
const results::SensitivityRow* least_of(const std::vector<results::SensitivityRow>& rows,
                                        const std::string& algorithm, const MeasuringMethod& method)
{
    const results::SensitivityRow* least = nullptr;
    for (const results::SensitivityRow& row : rows) {
        const bool is_one = row.algorithm == algorithm && method_of(row) == method;
        if (is_one && (least == nullptr || row.limit < least->limit)) least = &row;
    }
    return least;
}

std::string bars_caption(const std::vector<results::SensitivityRow>& rows)
{
    std::string out = "Least of the tasks. From left to right: ";
    bool is_first = true;
    for (const MeasuringMethod& method : distinct(rows, method_of)) {
        out += fmt::format("{}order {} {}", is_first ? "" : ", ", method.filter_order, method.hand);
        is_first = false;
    }
    return out + ". An arrow: not reached within the range.";
}

/// A group for each algorithm, a bar for each method, with intervals.
page::Figure ways_figure(const std::vector<results::SensitivityRow>& rows)
{
    page::Bars groups;
    for (const auto& algorithm : distinct(rows, [](const auto& row) { return row.algorithm; })) {
        page::BarGroup group{algorithm, {}};
        for (const MeasuringMethod& method : distinct(rows, method_of)) {
            const results::SensitivityRow* row = least_of(rows, algorithm, method);
            if (row == nullptr) continue;
            page::Bar bar{.series = fmt::format("order {} {}", method.filter_order, method.hand),
                          .value = row->limit,
                          .text = shown(row->limit, row->limit < 20.0 ? 1 : 0),
                          .colour = colour_of(algorithm),
                          .is_open = row->is_open(),
                          .tip = fmt::format("{}: order {}, {}, {} seeds", algorithm,
                                             method.filter_order, method.hand, row->seeds)};
            if (row->ci_low && row->ci_high)
                bar.interval = page::Range{*row->ci_low, *row->ci_high};
            group.bars.push_back(std::move(bar));
        }
        groups.push_back(std::move(group));
    }
    const auto& first = rows.front();
    return {.id = page::plain_id("trust-" + first.impairment),
            .title = fmt::format("Limit of {}", impairment_text(first.impairment)),
            .x = {""},
            .y = {"limit", std::string{unit_text(first.unit)}},
            .content = std::move(groups),
            .size = {900.0, 260.0},
            .caption = bars_caption(rows)};
}

} // namespace

std::optional<Section> trust_section(const results::Results& results)
{
    if (results.sensitivity.empty()) return std::nullopt;
    Section section{"trust", "How far a limit can be trusted"};
    section.add(page::paragraph(
        "A limit is where a measure crosses a threshold, so it moves with how the measure is "
        "taken: "
        "with the order of the filter that separates vibration from motion, and with how firmly "
        "the hand holds. What moves little is a finding; what moves much is a convention."));
    section.sources = files_named(results, "limits_by_convention.csv");
    std::vector<Json> tables;
    const auto names = distinct(results.sensitivity, [](const auto& r) { return r.impairment; });
    for (const std::string& name : names) {
        const auto rows = rows_where(results.sensitivity,
                                     [&](const auto& row) { return row.impairment == name; });
        section.add(ways_figure(rows));
        tables.push_back(ways_table(rows));
    }
    for (Json& table : tables) section.add(std::move(table));
    return section;
}

} // namespace hapnet::lab::report
