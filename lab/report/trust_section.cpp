// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"
#include "proto/plot/bars.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

using plot::escaped;

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

std::string ways_table(const std::vector<results::SensitivityRow>& rows)
{
    const std::string caption =
        fmt::format("Limit of {}, {}, by the order of the 20 Hz filter and the hands",
                    impairment_text(rows.front().impairment), unit_text(rows.front().unit));
    HtmlTable table{caption, {"algorithm", "task", "from … to"}};
    const auto methods = distinct(rows, method_of);
    for (const MeasuringMethod& method : methods) {
        table.heads.push_back(
            fmt::format("order {}<br>{}", plain(method.filter_order), escaped(method.hand)));
    }
    std::vector<std::pair<std::string, std::string>> seen;
    for (const results::SensitivityRow& like : rows) {
        const std::pair key{like.algorithm, like.task};
        if (std::find(seen.begin(), seen.end(), key) != seen.end()) continue;
        seen.push_back(key);
        std::vector<HtmlCell> cells;
        plot::Range range;
        bool is_open = false;
        for (const MeasuringMethod& method : methods) {
            const results::SensitivityRow* row = row_of(rows, like, method);
            cells.push_back({row == nullptr
                                 ? "–"
                                 : escaped((row->is_open() ? "> " : "") +
                                           shown(row->limit, row->limit < 20.0 ? 1 : 0))});
            if (row == nullptr) continue;
            range.include(row->limit);
            is_open |= row->is_open() && row->limit >= range.high;
        }
        const auto span = fmt::format("{} … {}{}", shown(range.low, 1), is_open ? "> " : "",
                                      shown(range.high, 1));
        cells.insert(
            cells.begin(),
            {{escaped(like.algorithm)}, {escaped(like.task), "name"}, {escaped(span), "ours"}});
        table.rows.push_back(std::move(cells));
    }
    return html_of(table);
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

/// A group for each algorithm, a bar for each method, with intervals.
Drawing ways_plot(const std::vector<results::SensitivityRow>& rows)
{
    std::vector<plot::BarGroup> groups;
    for (const auto& algorithm : distinct(rows, [](const auto& row) { return row.algorithm; })) {
        plot::BarGroup group{algorithm, {}};
        for (const MeasuringMethod& method : distinct(rows, method_of)) {
            const results::SensitivityRow* row = least_of(rows, algorithm, method);
            if (row == nullptr) continue;
            plot::Bar bar{.value = row->limit,
                          .label = shown(row->limit, row->limit < 20.0 ? 1 : 0),
                          .colour = colour_of(algorithm),
                          .is_open = row->is_open(),
                          .tip = fmt::format("{}: order {}, {}, {} seeds", algorithm,
                                             method.filter_order, method.hand, row->seeds)};
            if (row->ci_low && row->ci_high)
                bar.interval = plot::Range{*row->ci_low, *row->ci_high};
            group.bars.push_back(std::move(bar));
        }
        groups.push_back(std::move(group));
    }
    const auto& first = rows.front();
    const std::string title = fmt::format("Limit of {}", impairment_text(first.impairment));
    return drawn_bars({title, "", unit_text(first.unit)}, groups, {}, {900.0, 260.0});
}

std::string bars_caption(const std::vector<results::SensitivityRow>& rows)
{
    std::string out = "Least of the tasks. From left to right: ";
    bool is_first = true;
    for (const MeasuringMethod& method : distinct(rows, method_of)) {
        out += fmt::format("{}order {} {}", is_first ? "" : ", ", method.filter_order,
                           escaped(method.hand));
        is_first = false;
    }
    return out + ". An arrow: not reached within the range.";
}

} // namespace

std::optional<Section> trust_section(const results::Results& results)
{
    if (results.sensitivity.empty()) return std::nullopt;
    Section section{"trust", "How far a limit can be trusted",
                    "<p>A limit is where a measure crosses a threshold, so it moves with how the "
                    "measure is taken: with the order of the filter that separates vibration from "
                    "motion, and with how firmly the hand holds. What moves little is a finding; "
                    "what moves much is a convention.</p>\n"};
    section.html += "<div>\n";
    section.sources = links_to(results, "limits_by_convention.csv");
    std::string tables;
    const auto names = distinct(results.sensitivity, [](const auto& r) { return r.impairment; });
    for (const std::string& name : names) {
        std::vector<results::SensitivityRow> rows;
        for (const results::SensitivityRow& row : results.sensitivity) {
            if (row.impairment == name) rows.push_back(row);
        }
        section.add_figure("trust-" + name, ways_plot(rows), bars_caption(rows));
        tables += ways_table(rows);
    }
    section.html += "</div>\n" + tables;
    return section;
}

} // namespace hapnet::lab::report
