// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/device_state/state.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer::device_state {

namespace {

constexpr int version = 1;
constexpr double heat_max = 100.0; // upper limit of GovernorLimits::heat_start

bool is_plain(char c)
{
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    return is_letter || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

std::string escaped(std::string_view text)
{
    std::string out;
    for (const char c : text) {
        if (is_plain(c)) {
            out += c;
        } else {
            out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
        }
    }
    return out;
}

/// Returns a number of at least 0, or nullopt for null. The error is for any other value.
base::Result<std::optional<double>> number_in(const nlohmann::json& document, const char* key)
{
    const auto found = document.find(key);
    if (found == document.end()) return base::fail(fmt::format("'{}' is missing", key));
    if (found->is_null()) return std::nullopt;
    if (!found->is_number()) return base::fail(fmt::format("'{}' is not a number", key));
    const double value = found->get<double>();
    if (!(value >= 0.0) || std::isinf(value)) {
        return base::fail(fmt::format("'{}' is out of range", key));
    }
    return value;
}

} // namespace

std::string_view why_untested(const DeviceState& state, double now_s)
{
    if (!state.self_test_passed_s) return "it has not passed a self-test on this machine";
    const double age_s = now_s - *state.self_test_passed_s;
    if (age_s < 0.0) return "its self-test is dated in the future: check the clock";
    return age_s > self_test_valid_s ? "its self-test is older than 30 days" : "";
}

double heat_at_start(const DeviceState& state, const Moment& moment, base::Duration heat_time)
{
    if (!state.heat) return unknown_heat;
    const double since_s = moment.now_s - state.heat->at_s;
    if (since_s < 0.0 || state.heat->at_s < moment.booted_s) return unknown_heat;
    return state.heat->heat * std::exp(-since_s / base::to_seconds(heat_time));
}

std::string to_text(const DeviceState& state)
{
    nlohmann::ordered_json out{{"format", "hapnet-device-state"},
                               {"version", version},
                               {"self_test_passed_unix_s", nullptr},
                               {"heat", nullptr},
                               {"heat_unix_s", nullptr}};
    if (state.self_test_passed_s) out["self_test_passed_unix_s"] = *state.self_test_passed_s;
    if (state.heat) {
        out["heat"] = std::min(state.heat->heat, heat_max);
        out["heat_unix_s"] = state.heat->at_s;
    }
    return out.dump(2) + "\n";
}

base::Result<DeviceState> parse(std::string_view text)
{
    const auto document = nlohmann::json::parse(text, nullptr, false);
    if (!document.is_object()) return base::fail("it is not a JSON object");
    if (document.value("format", nlohmann::json{}) != "hapnet-device-state" ||
        document.value("version", nlohmann::json{}) != version) {
        return base::fail("it is no hapnet-device-state of version 1");
    }
    const auto passed = number_in(document, "self_test_passed_unix_s");
    if (!passed) return tl::unexpected{passed.error()};
    const auto heat = number_in(document, "heat");
    if (!heat) return tl::unexpected{heat.error()};
    const auto at = number_in(document, "heat_unix_s");
    if (!at) return tl::unexpected{at.error()};
    DeviceState state{.self_test_passed_s = *passed};
    if (*heat && *at && **heat <= heat_max) state.heat = DeviceState::Heat{**heat, **at};
    return state;
}

std::string file_name(const device::Identity& identity, std::string_view place)
{
    const std::string_view which = identity.serial.empty() ? place : identity.serial;
    return fmt::format("{}-{}.json", escaped(identity.backend),
                       which.empty() ? "only" : escaped(which));
}

} // namespace hapnet::peer::device_state
