// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/frames.hpp"

#include "proto/control/core/request.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::web {

namespace {

using Json = nlohmann::ordered_json;

// Above these limits the other program is not a daemon of this project.
constexpr std::size_t line_bytes_max = std::size_t{64} << 10;
constexpr double number_max = 1e12;
constexpr std::size_t entries_max = 64;

/// Reads members and remembers the first error.
class FrameReader {
public:
    explicit FrameReader(const Json& json) : json_{json} {}

    [[nodiscard]] bool is_good() const { return wrong_.empty(); }
    [[nodiscard]] const std::string& wrong() const { return wrong_; }

    /// Reads the number at a pointer such as "/late_us/max"; NaN where it is missing or null.
    double optional_number(const char* pointer) { return number_in(json_, pointer); }

    double number(const char* pointer)
    {
        const double value = optional_number(pointer);
        if (std::isnan(value)) fail(pointer);
        return std::isnan(value) ? 0.0 : value;
    }

    glm::dvec3 vector(const char* key)
    {
        const auto found = json_.find(key);
        if (found == json_.end() || !found->is_array() || found->size() != 3) {
            fail(key);
            return glm::dvec3{0.0};
        }
        glm::dvec3 v{0.0};
        for (int i = 0; i < 3; ++i) {
            const double value = checked((*found)[static_cast<std::size_t>(i)], key);
            v[i] = std::isnan(value) ? 0.0 : value;
        }
        return v;
    }

    /// Reads a whole number of nanoseconds.
    base::TimePoint time(const char* key)
    {
        const auto found = json_.find(key);
        if (found == json_.end() || !found->is_number_integer() || *found < 0 ||
            *found > std::int64_t{1} << 60) {
            fail(key);
            return {};
        }
        return base::TimePoint{base::Duration{found->get<std::int64_t>()}};
    }

    /// Reads a list of objects.
    const Json* list(const char* key)
    {
        const auto found = json_.find(key);
        if (found == json_.end() || !found->is_array() || found->size() > entries_max ||
            !std::ranges::all_of(*found, [](const Json& one) { return one.is_object(); })) {
            fail(key);
            return nullptr;
        }
        return &*found;
    }

    double number_in(const Json& json, const std::string& pointer)
    {
        const Json::json_pointer place{pointer};
        if (!json.contains(place)) return unknown;
        return checked(json.at(place), pointer);
    }

    void fail(std::string_view what)
    {
        if (wrong_.empty()) wrong_ = fmt::format("{} is missing or out of range", what);
    }

private:
    double checked(const Json& value, std::string_view what)
    {
        if (value.is_null()) return unknown;
        if (!value.is_number()) {
            fail(what);
            return unknown;
        }
        const auto number = value.get<double>();
        if (!(std::abs(number) <= number_max)) fail(what);
        return number;
    }

    const Json& json_;
    std::string wrong_;
};

base::Result<Json> parsed(std::string_view line)
{
    if (line.size() > line_bytes_max) return base::fail("a frame of more than 64 KiB");
    auto json = control::parse_object(line);
    if (!json) return json;
    const auto ok = json->find("ok");
    if (ok != json->end() && *ok == true) return json;
    const auto error = json->find("error");
    const bool says_why = error != json->end() && error->is_string();
    return base::fail(says_why ? error->get<std::string>() : "no frame");
}

double or_zero(double value) { return std::isnan(value) ? 0.0 : value; }

PeerFrame::Heard heard_in(const Json& json, FrameReader& in)
{
    const double from = in.number_in(json, "/from");
    if (!(from >= 1.0 && from <= 65535.0)) in.fail("heard/from");
    return {.from = static_cast<std::uint16_t>(from >= 1.0 && from <= 65535.0 ? from : 0.0),
            .lost = or_zero(in.number_in(json, "/lost")),
            .delay_mean_ms = in.number_in(json, "/delay_ms/mean"),
            .delay_max_ms = in.number_in(json, "/delay_ms/max"),
            .age_ms = in.number_in(json, "/age_ms"),
            .offset_ms = in.number_in(json, "/offset_ms"),
            .uncertainty_ms = in.number_in(json, "/uncertainty_ms")};
}

EmulatorFrame::Way way_in(const Json& json, const std::string& way, FrameReader& in)
{
    EmulatorFrame::Way out{.received = or_zero(in.number_in(json, way + "/received")),
                           .in_flight = or_zero(in.number_in(json, way + "/in_flight")),
                           .delay_mean_ms = in.number_in(json, way + "/delay_ms/mean"),
                           .delay_max_ms = in.number_in(json, way + "/delay_ms/max"),
                           .late_max_us = in.number_in(json, way + "/late_us/max")};
    const Json::json_pointer place{way + "/dropped"};
    if (!json.contains(place) || !json.at(place).is_object()) {
        in.fail(way + "/dropped");
        return out;
    }
    for (const auto& [cause, count] : json.at(place).items()) {
        if (!count.is_number()) in.fail(way + "/dropped");
        if (count.is_number()) out.dropped += count.get<double>();
    }
    return out;
}

/// Returns the name in a form that may be part of the name of a column.
std::string plain_name(const Json& json, FrameReader& in)
{
    const auto found = json.find("name");
    if (found == json.end() || !found->is_string() ||
        found->get_ref<const std::string&>().size() > 80) {
        in.fail("paths/name");
        return {};
    }
    std::string name = found->get<std::string>();
    std::ranges::replace_if(
        name,
        [](unsigned char c) { return c <= ' ' || c >= 127 || c == '"' || c == '\\' || c == '<'; },
        '_');
    return name;
}

} // namespace

base::Result<PeerFrame> parse_peer_frame(std::string_view line)
{
    const auto json = parsed(line);
    if (!json) return tl::unexpected{json.error()};
    FrameReader in{*json};
    PeerFrame frame{.text = std::string{line},
                    .cube = {in.time("at_ns"), in.vector("cube"), in.vector("cube_v")},
                    .force_n = glm::length(in.vector("hand_force")),
                    .force_max_n = in.number("/force_n/max"),
                    .late_max_us = in.number("/late_us/max"),
                    .missed = in.number("/missed"),
                    .phase = {},
                    .heard = {}};
    const auto phase = json->find("phase");
    if (phase != json->end() && phase->is_string()) frame.phase = phase->get<std::string>();
    if (const Json* heard = in.list("heard")) {
        for (const Json& one : *heard) frame.heard.push_back(heard_in(one, in));
    }
    if (!in.is_good()) return base::fail(in.wrong());
    return frame;
}

base::Result<EmulatorFrame> parse_emulator_frame(std::string_view line)
{
    const auto json = parsed(line);
    if (!json) return tl::unexpected{json.error()};
    FrameReader in{*json};
    EmulatorFrame frame{.text = std::string{line}, .at = {}, .paths = {}};
    frame.at = in.time("at_ns");
    frame.elapsed_s = or_zero(in.number("/elapsed_s"));
    frame.generation = static_cast<std::uint64_t>(std::max(0.0, in.number("/generation")));
    if (const Json* paths = in.list("paths")) {
        for (const Json& one : *paths) {
            frame.paths.push_back(
                {plain_name(one, in), way_in(one, "/up", in), way_in(one, "/down", in)});
        }
    }
    if (!in.is_good()) return base::fail(in.wrong());
    return frame;
}

} // namespace hapnet::web
