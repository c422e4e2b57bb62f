// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"
#include "proto/plot/plot.hpp"

#include <map>
#include <spdlog/fmt/fmt.h>
#include <tuple>

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
            cells.push_back(
                {row == nullptr ? "–" : escaped((row->is_open() ? "> " : "") + plain(row->limit))});
            if (row == nullptr) continue;
            range.include(row->limit);
            is_open |= row->is_open() && row->limit >= range.high;
        }
        const auto span =
            fmt::format("{} … {}{}", plain(range.low), is_open ? "> " : "", plain(range.high));
        cells.insert(
            cells.begin(),
            {{escaped(like.algorithm)}, {escaped(like.task), "name"}, {escaped(span), "ours"}});
        table.rows.push_back(std::move(cells));
    }
    return html_of(table);
}

/// The hands in the order of their strokes: nominal first.
std::vector<std::string> hands_of(const std::vector<results::SensitivityRow>& rows)
{
    auto hands = distinct(rows, [](const auto& row) { return row.hand; });
    std::stable_partition(hands.begin(), hands.end(),
                          [](const std::string& hand) { return hand == "nominal"; });
    return hands;
}

/// The least limit over the tasks, by algorithm, hand and order.
using Least = std::map<std::tuple<std::string, std::string, double>, double>;

std::string ways_plot(const std::vector<results::SensitivityRow>& rows)
{
    Least least;
    for (const results::SensitivityRow& row : rows) {
        const auto key = std::tuple{row.algorithm, row.hand, static_cast<double>(row.filter_order)};
        const auto [found, is_new] = least.emplace(key, row.limit);
        if (!is_new) found->second = std::min(found->second, row.limit);
    }
    constexpr std::array strokes{plot::Stroke::solid, plot::Stroke::dashed, plot::Stroke::dotted};
    std::vector<plot::Curve> curves;
    const auto hands = hands_of(rows);
    const auto algorithms = distinct(rows, [](const auto& row) { return row.algorithm; });
    for (const std::string& algorithm : algorithms) {
        for (std::size_t i = 0; i < hands.size(); ++i) {
            plot::Curve curve{i == 0 ? std::string_view{algorithm} : "",
                              colour_of(algorithm),
                              {},
                              strokes[i % strokes.size()],
                              true};
            for (const auto& [key, limit] : least) {
                const auto& [of, hand, order] = key;
                if (of == algorithm && hand == hands[i]) curve.points.push_back({order, limit});
            }
            curves.push_back(std::move(curve));
        }
    }
    const auto& first = rows.front();
    const std::string title = fmt::format("Limit of {}", impairment_text(first.impairment));
    return plot::svg_plot({title, "order of the filter", unit_text(first.unit)}, curves,
                          {.size = {440.0, 250.0}, .y = {0.0, 0.0}});
}

std::string strokes_caption(const std::vector<results::SensitivityRow>& rows)
{
    constexpr std::array<std::string_view, 3> names{"solid", "dashed", "dotted"};
    std::string out = "Least of the tasks. Hands: ";
    const auto hands = hands_of(rows);
    for (std::size_t i = 0; i < hands.size(); ++i) {
        out +=
            fmt::format("{}{} {}", i == 0 ? "" : ", ", names[i % names.size()], escaped(hands[i]));
    }
    return out + ".";
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
    section.html += "<div class='panels'>\n";
    std::string tables;
    const auto names = distinct(results.sensitivity, [](const auto& r) { return r.impairment; });
    for (const std::string& name : names) {
        std::vector<results::SensitivityRow> rows;
        for (const results::SensitivityRow& row : results.sensitivity) {
            if (row.impairment == name) rows.push_back(row);
        }
        section.add_figure("trust-" + name, ways_plot(rows), strokes_caption(rows));
        tables += ways_table(rows);
    }
    section.html += "</div>\n" + tables;
    return section;
}

} // namespace hapnet::lab::report
