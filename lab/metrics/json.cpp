// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/json.hpp"

#include "lab/metrics/criteria.hpp"
#include "proto/base/fields_json.hpp"

#include <string>

namespace hapnet::lab::metrics {

namespace {

/// The format of a member that no text has: it is written as JSON alone.
struct JsonOnly {
    void read(const base::Node&, auto&, base::Reading&) const {}
    [[nodiscard]] std::string print(const auto&) const { return {}; }
    [[nodiscard]] std::string describe() const { return {}; }
};

} // namespace

constexpr auto fields_of(base::Tag<Spread>)
{
    return base::fields("spread", base::field("mean", &Spread::mean),
                        base::field("min", &Spread::min), base::field("max", &Spread::max),
                        base::field("std", &Spread::std));
}

constexpr auto fields_of(base::Tag<ForceSteps>)
{
    return base::fields("force steps", base::field("largest_n", &ForceSteps::largest_n),
                        base::field("reversals", &ForceSteps::reversals));
}

constexpr auto fields_of(base::Tag<Similarity>)
{
    return base::fields("similarity", base::field("share", &Similarity::share),
                        base::field("lag_s", &Similarity::lag_s));
}

constexpr auto fields_of(base::Tag<BodyApart>)
{
    constexpr auto field = [](std::string_view key, auto member) {
        return base::field(key, member, JsonOnly{});
    };
    return base::fields("body", field("discrepancy_x_m", &BodyApart::discrepancy_x_m),
                        field("discrepancy_m", &BodyApart::discrepancy_m),
                        field("turned_apart_rad", &BodyApart::turned_apart_rad),
                        field("settled_m", &BodyApart::settled_m),
                        field("settled_rad", &BodyApart::settled_rad));
}

/// All but the task, which is a name.
constexpr auto fields_of(base::Tag<Metrics>)
{
    constexpr auto field = [](std::string_view key, auto member) {
        return base::field(key, member, JsonOnly{});
    };
    return base::fields(
        "metrics", field("scored_s", &Metrics::scored_s),
        field("body_vibration_m", &Metrics::body_vibration_m),
        field("stiffness_n_per_m", &Metrics::stiffness_n_per_m),
        field("force_discrepancy", &Metrics::force_discrepancy),
        field("discrepancy_m", &Metrics::discrepancy_m),
        field("turned_apart_rad", &Metrics::turned_apart_rad), field("bodies", &Metrics::bodies),
        field("force_vibration_n", &Metrics::force_vibration_n),
        field("force_above_2hz_n", &Metrics::force_above_2hz_n),
        field("felt_vibration_n", &Metrics::felt_vibration_n),
        field("contact_lost", &Metrics::contact_lost), field("force_steps", &Metrics::force_steps),
        field("energy_taken_j", &Metrics::energy_taken_j), field("drag_n", &Metrics::drag_n),
        field("path_rms_m", &Metrics::path_rms_m), field("drops", &Metrics::drops),
        field("overshoot_m", &Metrics::overshoot_m), field("response_s", &Metrics::response_s),
        field("similarity", &Metrics::similarity));
}

nlohmann::ordered_json to_json(const Metrics& metrics)
{
    nlohmann::ordered_json json{{"task", std::string{device::name_of(metrics.task)}}};
    json.update(base::json_of(metrics));
    return json;
}

std::optional<Metrics> metrics_from(const nlohmann::json& json)
{
    Metrics metrics;
    if (!base::read_json(json, metrics)) return std::nullopt;
    const auto name = json.find("task");
    if (name == json.end() || !name->is_string()) return std::nullopt;
    const auto task = device::task_named(name->get_ref<const std::string&>());
    if (!task) return std::nullopt;
    metrics.task = *task;
    return metrics;
}

} // namespace hapnet::lab::metrics
