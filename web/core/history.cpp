// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/history.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::web {

namespace {

void put_number(std::string& text, double value)
{
    if (std::isfinite(value)) {
        fmt::format_to(std::back_inserter(text), "{:.5g}", value);
    } else {
        text += "null";
    }
}

void put_columns(std::string& text, const std::vector<std::string>& columns)
{
    text += "\"columns\":[";
    for (std::size_t i = 0; i < columns.size(); ++i) {
        fmt::format_to(std::back_inserter(text), "{}\"{}\"", i == 0 ? "" : ",", columns[i]);
    }
    text += "],\"rows\":[";
}

} // namespace

void History::set_columns(std::vector<std::string> columns)
{
    if (columns.size() > columns_max) columns.resize(columns_max);
    if (columns == columns_) return;
    columns_ = std::move(columns);
    clear();
}

void History::clear()
{
    rows_.clear();
    coarse_.clear();
    growing_ = {};
    grown_ = 0;
}

void History::add(const std::vector<double>& row)
{
    base::ensure(!columns_.empty() && row.size() >= columns_.size());
    Row kept{row.front(), {}};
    for (std::size_t i = 1; i < columns_.size(); ++i) {
        kept.values.push_back(static_cast<float>(row[i]));
    }
    if (grown_ == 0) {
        growing_ = {kept.values, kept.values, kept.at_s};
    } else {
        for (std::size_t i = 0; i < kept.values.size(); ++i) {
            // If one argument is NaN, fmin() and fmax() return the other one.
            growing_.least[i] = std::fmin(growing_.least[i], kept.values[i]);
            growing_.greatest[i] = std::fmax(growing_.greatest[i], kept.values[i]);
        }
    }
    if (++grown_ == every) {
        if (coarse_.size() == coarse_max) coarse_.pop_front();
        coarse_.push_back(std::move(growing_));
        grown_ = 0;
    }
    if (rows_.size() == rows_max) rows_.pop_front();
    rows_.push_back(std::move(kept));
}

std::string History::fine_json() const
{
    std::string text = "{\"type\":\"history\",\"seconds\":120,";
    put_columns(text, columns_);
    for (const Row& row : rows_) {
        fmt::format_to(std::back_inserter(text), "{}[{:.3f}", &row == &rows_.front() ? "" : ",",
                       row.at_s);
        for (const float value : row.values) {
            text += ',';
            put_number(text, static_cast<double>(value));
        }
        text += ']';
    }
    return text + "]}";
}

std::string History::coarse_json() const
{
    std::string text = fmt::format("{{\"ok\":true,\"every_frames\":{},", every);
    put_columns(text, columns_);
    for (const Extremes& row : coarse_) {
        fmt::format_to(std::back_inserter(text), "{}[{:.3f}", &row == &coarse_.front() ? "" : ",",
                       row.at_s);
        for (std::size_t i = 0; i < row.least.size(); ++i) {
            text += ",[";
            put_number(text, static_cast<double>(row.least[i]));
            text += ',';
            put_number(text, static_cast<double>(row.greatest[i]));
            text += ']';
        }
        text += ']';
    }
    return text + "]}";
}

} // namespace hapnet::web
