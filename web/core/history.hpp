// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

namespace hapnet::web {

/// The figures of past live frames, so that a page that connects later sees its charts at once: all
/// rows of two minutes, and the extremes of every eight rows of twenty minutes. Its size is
/// bounded. NaN: not known.
class History {
public:
    static constexpr std::size_t rows_max = 120UL * 60UL;
    static constexpr std::size_t every = 8;
    static constexpr std::size_t coarse_max = 20UL * 60UL * 60UL / every;
    /// Largest number of columns; further columns are left out. 8 peers have 28 pairs and 28 links.
    static constexpr std::size_t columns_max = 256;

    /// Sets the columns and empties the history if they have changed. The first column is the time.
    void set_columns(std::vector<std::string> columns);
    void clear();

    /// Adds a row with one value for each column.
    void add(const std::vector<double>& row);

    [[nodiscard]] std::size_t size() const { return rows_.size(); }
    [[nodiscard]] std::size_t coarse_size() const { return coarse_.size(); }

    /// These functions return {"type":"history",...} and the answer to GET /api/history; see
    /// docs/formats/live.md.
    [[nodiscard]] std::string fine_json() const;
    [[nodiscard]] std::string coarse_json() const;

private:
    struct Extremes {
        std::vector<float> least;
        std::vector<float> greatest;
        double at_s = 0.0; // time of the first row in it
    };

    std::vector<std::string> columns_;
    struct Row {
        double at_s = 0.0;
        std::vector<float> values; // values of all columns but the time
    };
    std::deque<Row> rows_;
    std::deque<Extremes> coarse_;
    Extremes growing_;
    std::size_t grown_ = 0; // rows in growing_
};

} // namespace hapnet::web
