// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/json.hpp"

#include <cstddef>
#include <string>

namespace hapnet::lab {

namespace {

using OrderedJson = nlohmann::ordered_json;
using PlainJson = nlohmann::json;

// The members of the structures, named once for writing and reading.

template <typename Visit>
void each_member(auto& of, const Visit& visit) requires requires
{
    of.fourth;
}
{
    visit("first", of.first);
    visit("second", of.second);
    visit("fourth", of.fourth);
}

template <typename Visit>
void each_member(auto& of, const Visit& visit) requires requires
{
    of.std;
}
{
    visit("mean", of.mean);
    visit("min", of.min);
    visit("max", of.max);
    visit("std", of.std);
}

template <typename Visit>
void each_member(auto& of, const Visit& visit) requires requires
{
    of.reversals;
}
{
    visit("largest_n", of.largest_n);
    visit("reversals", of.reversals);
}

template <typename Visit>
void each_member(auto& of, const Visit& visit) requires requires
{
    of.lag_s;
}
{
    visit("share", of.share);
    visit("lag_s", of.lag_s);
}

template <typename Visit>
void each_member(auto& of, const Visit& visit) requires requires
{
    of.scored_s;
}
{
    visit("task", of.task);
    visit("scored_s", of.scored_s);
    visit("body_vibration_m", of.body_vibration_m);
    visit("stiffness_n_per_m", of.stiffness_n_per_m);
    visit("force_discrepancy", of.force_discrepancy);
    visit("discrepancy_m", of.discrepancy_m);
    visit("force_vibration_n", of.force_vibration_n);
    visit("felt_vibration_n", of.felt_vibration_n);
    visit("contact_lost", of.contact_lost);
    visit("force_steps", of.force_steps);
    visit("energy_taken_j", of.energy_taken_j);
    visit("drag_n", of.drag_n);
    visit("path_rms_m", of.path_rms_m);
    visit("drops", of.drops);
    visit("overshoot_m", of.overshoot_m);
    visit("response_s", of.response_s);
    visit("similarity", of.similarity);
}

OrderedJson written(double value) { return value; }
OrderedJson written(device::Task task) { return std::string{device::name_of(task)}; }

template <typename Value>
OrderedJson written(const Value& value);

template <typename Value>
OrderedJson written(const std::optional<Value>& value)
{
    return value ? written(*value) : OrderedJson();
}

template <typename Value, std::size_t count>
OrderedJson written(const std::array<Value, count>& values)
{
    OrderedJson list = OrderedJson::array();
    for (const Value& value : values) list.push_back(written(value));
    return list;
}

template <typename Value>
OrderedJson written(const Value& value)
{
    OrderedJson object = OrderedJson::object();
    each_member(value, [&](const char* key, const auto& member) { object[key] = written(member); });
    return object;
}

bool read_into(const PlainJson& json, double& value)
{
    if (!json.is_number()) return false;
    value = json.get<double>();
    return true;
}

bool read_into(const PlainJson& json, device::Task& task)
{
    if (!json.is_string()) return false;
    const auto named = device::task_named(json.get_ref<const std::string&>());
    if (named) task = *named;
    return named.has_value();
}

template <typename Value>
bool read_into(const PlainJson& json, Value& value);

template <typename Value>
bool read_into(const PlainJson& json, std::optional<Value>& value)
{
    value.reset();
    return json.is_null() || read_into(json, value.emplace());
}

template <typename Value, std::size_t count>
bool read_into(const PlainJson& json, std::array<Value, count>& values)
{
    if (!json.is_array() || json.size() != count) return false;
    for (std::size_t i = 0; i < count; ++i) {
        if (!read_into(json[i], values[i])) return false;
    }
    return true;
}

template <typename Value>
bool read_into(const PlainJson& json, Value& value)
{
    if (!json.is_object()) return false;
    bool good = true;
    each_member(value, [&](const char* key, auto& member) {
        const auto found = json.find(key);
        good = good && found != json.end() && read_into(*found, member);
    });
    return good;
}

} // namespace

nlohmann::ordered_json to_json(const Metrics& metrics) { return written(metrics); }

std::optional<Metrics> metrics_from(const nlohmann::json& json)
{
    Metrics metrics;
    if (!read_into(json, metrics)) return std::nullopt;
    return metrics;
}

} // namespace hapnet::lab
