// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/output/metrics.hpp"

#include "proto/output/plain.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>

namespace hapnet::output {

namespace {

using Json = nlohmann::ordered_json;
using Labels = std::map<std::string, std::string>;
using Shape = base::ValueKind::Shape;

constexpr double ns_per_s = 1e9;

/// True if Prometheus accepts the text as the name of a metric or a label.
bool is_name(std::string_view text)
{
    const auto may_stand = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_';
    };
    return !text.empty() && !(text.front() >= '0' && text.front() <= '9') &&
           std::ranges::all_of(text, may_stand);
}

std::string one_line(std::string text)
{
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\\'; }, ' ');
    return text;
}

/// Returns a text in quotes, in the syntax of Prometheus.
std::string quoted_label(std::string_view text)
{
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '\\' || c == '"') quoted += '\\';
        quoted += c == '\n' ? ' ' : c;
    }
    return quoted + '"';
}

/// Calls visit(name, number) for a number, or for each number below an object, whose name then
/// includes the keys.
template <typename Visit>
void for_each_number(const Json& json, const std::string& name, const Visit& visit)
{
    if (json.is_number()) return visit(name, json.get<double>());
    if (!json.is_object()) return;
    for (const auto& [key, value] : json.items()) for_each_number(value, name + '_' + key, visit);
}

Labels with(Labels labels, std::string_view name, std::string_view value)
{
    labels.insert_or_assign(std::string{name}, std::string{value});
    return labels;
}

std::string line_of(const Metric& metric, const Sample& sample)
{
    std::string labels;
    for (const auto& [name, value] : sample.labels) {
        labels += fmt::format("{}{}={}", labels.empty() ? "" : ",", name, quoted_label(value));
    }
    if (!labels.empty()) labels = '{' + labels + '}';
    return fmt::format("{}{} {:.15g}\n", metric.name, labels, sample.value);
}

std::optional<Sample> sample_in(const Json& json)
{
    const auto value = json.is_object() ? json.find("value") : json.end();
    const auto labels = json.is_object() ? json.find("labels") : json.end();
    if (value == json.end() || !value->is_number()) return std::nullopt;
    Sample sample{.labels = {}, .value = value->get<double>()};
    if (labels == json.end() || !labels->is_object()) return sample;
    for (const auto& [name, label] : labels->items()) {
        if (label.is_string() && is_name(name)) sample.labels[name] = label.get<std::string>();
    }
    return sample;
}

} // namespace

Metric& Metrics::metric_of(const std::string& name, std::string_view help, bool is_counter)
{
    const auto known = std::ranges::find(all_, name, &Metric::name);
    if (known != all_.end()) return *known;
    return all_.emplace_back(Metric{name, std::string{help}, is_counter, {}});
}

void Metrics::add_row(const base::FieldRow& row, const Json& json, const Labels& labels)
{
    const base::Metric& told = row.telling.metric;
    const auto unit = base::time_unit_of(row.key);
    const auto add_numbers = [&](const Json& value, const Labels& own) {
        for_each_number(value, std::string{told.name}, [&](std::string name, double number) {
            if (unit) name += "_seconds";
            if (told.is_counter) name += "_total";
            Metric& metric = metric_of(name, plain(row.about), told.is_counter);
            metric.samples.push_back({own, unit ? number * *unit / ns_per_s : number});
        });
    };
    const base::ValueKind& kind = row.kind->plain();
    if (!told.name.empty() && told.label.empty()) return add_numbers(json, labels);
    if (!json.is_object()) return;
    if (kind.shape == Shape::map && !told.label.empty()) {
        for (const auto& [name, value] : json.items()) {
            const auto own = with(labels, told.label, name);
            if (!told.name.empty()) {
                add_numbers(value, own);
            } else {
                add(kind.element->table(), value, own);
            }
        }
    } else if (kind.shape == Shape::record) {
        add(kind.table(), json, told.label.empty() ? labels : with(labels, told.label, row.key));
    }
}

void Metrics::add(const base::FieldTable& fields, const Json& json, const Labels& labels)
{
    if (!json.is_object()) return;
    for (const base::FieldRow& row : fields.rows) {
        const auto value = json.find(row.key);
        if (value != json.end()) add_row(row, *value, labels);
    }
}

void Metrics::add(const Json& told)
{
    if (!told.is_array()) return;
    const auto text = [](const Json& json, const char* key) {
        const auto found = json.find(key);
        return found != json.end() && found->is_string() ? found->get<std::string>() : "";
    };
    for (const Json& one : told) {
        if (!one.is_object() || !is_name(text(one, "name"))) continue;
        Metric& metric = metric_of(text(one, "name"), one_line(text(one, "help")),
                                   text(one, "type") == "counter");
        const auto samples = one.find("samples");
        if (samples == one.end() || !samples->is_array()) continue;
        for (const Json& sample : *samples) {
            if (auto read = sample_in(sample)) metric.samples.push_back(*std::move(read));
        }
    }
}

Json Metrics::json() const
{
    Json list = Json::array();
    for (const Metric& metric : all_) {
        Json samples = Json::array();
        for (const Sample& sample : metric.samples) {
            samples.push_back({{"labels", sample.labels}, {"value", sample.value}});
        }
        list.push_back({{"name", metric.name},
                        {"help", metric.help},
                        {"type", metric.is_counter ? "counter" : "gauge"},
                        {"samples", std::move(samples)}});
    }
    return list;
}

std::string Metrics::text() const
{
    std::string text;
    for (const Metric& metric : all_) {
        text += fmt::format("# HELP {0} {1}\n# TYPE {0} {2}\n", metric.name, metric.help,
                            metric.is_counter ? "counter" : "gauge");
        for (const Sample& sample : metric.samples) {
            if (std::isfinite(sample.value)) text += line_of(metric, sample);
        }
    }
    return text;
}

} // namespace hapnet::output
