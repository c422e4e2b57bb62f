// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace hapnet::output {

/// A value of a metric, with its labels.
struct Sample {
    std::map<std::string, std::string> labels;
    double value = 0.0;
};

/// A Prometheus metric.
struct Metric {
    std::string name;
    std::string help;
    bool is_counter = false;
    std::vector<Sample> samples;
};

/// A list of metrics, in the order in which they were first added.
class Metrics {
public:
    /// Adds the metrics in the JSON of a struct, by the description of its fields. Names of times
    /// end with `_seconds`, the unit of their values, and names of counters with `_total`. Each
    /// number below a field that is a metric is also a metric: its name ends with the keys below
    /// the field.
    void add(const base::FieldTable& fields, const nlohmann::ordered_json& json,
             const std::map<std::string, std::string>& labels = {});
    /// Adds the metrics of another program from the result of its json(). Entries that are not
    /// metrics are ignored.
    void add(const nlohmann::ordered_json& told);

    /// Returns the metrics as a list, which add() accepts.
    [[nodiscard]] nlohmann::ordered_json json() const;
    /// Returns the metrics as text in the format of Prometheus (version 0.0.4).
    [[nodiscard]] std::string text() const;

private:
    Metric& metric_of(const std::string& name, std::string_view help, bool is_counter);
    void add_row(const base::FieldRow& row, const nlohmann::ordered_json& json,
                 const std::map<std::string, std::string>& labels);

    std::vector<Metric> all_;
};

} // namespace hapnet::output
