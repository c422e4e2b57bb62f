// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/irtt.hpp"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator::tools {

namespace {

using Value = nlohmann::json;

/// The fate of a question, as irtt writes it: "true" where irtt does not know the direction.
enum class TripFate : std::uint8_t { answered, lost, lost_up, lost_down };

struct RoundTrip {
    TripFate fate = TripFate::answered;
    std::optional<base::Duration> whole{};
    std::optional<base::Duration> send{};
    std::optional<base::Duration> receive{};
};

const Value* member(const Value& object, const char* name)
{
    if (!object.is_object()) return nullptr;
    const auto found = object.find(name);
    return found == object.end() ? nullptr : &*found;
}

/// Reads nanoseconds, at most 100 days. If the ends have two clocks, a delay may have any value.
std::optional<base::Duration> duration_in(const Value* delay, const char* name)
{
    constexpr std::int64_t most = 8'640'000'000'000'000;
    const Value* number = delay == nullptr ? nullptr : member(*delay, name);
    if (number == nullptr || !number->is_number_integer()) return std::nullopt;
    const auto value = number->get<std::int64_t>();
    return value < -most || value > most ? std::nullopt : std::optional{base::Duration{value}};
}

std::optional<TripFate> fate_in(const Value* lost)
{
    if (lost == nullptr) return std::nullopt;
    if (lost->is_boolean())
        return lost->get<bool>() ? TripFate::lost : TripFate::answered; // format of irtt before 0.9
    if (!lost->is_string()) return std::nullopt;
    const auto& word = lost->get_ref<const std::string&>();
    if (word == "false") return TripFate::answered;
    if (word == "true") return TripFate::lost;
    if (word == "true_up") return TripFate::lost_up;
    if (word == "true_down") return TripFate::lost_down;
    return std::nullopt;
}

base::Result<RoundTrip> round_trip_in(const Value& entry)
{
    const auto fate = fate_in(member(entry, "lost"));
    if (!fate) {
        return base::fail(
            R"("lost" must be "false", "true", "true_up" or "true_down", as irtt writes it)");
    }
    RoundTrip trip{.fate = *fate};
    if (*fate != TripFate::answered) return trip;
    const Value* delay = member(entry, "delay");
    const auto whole = duration_in(delay, "rtt");
    if (!whole || *whole < base::Duration{}) {
        return base::fail(R"("delay" has no "rtt" in nanoseconds)");
    }
    trip.whole = whole;
    trip.send = duration_in(delay, "send");
    trip.receive = duration_in(delay, "receive");
    return trip;
}

std::optional<base::Duration> spacing_in(const Value& json)
{
    const Value* config = member(json, "config");
    if (config == nullptr) return std::nullopt;
    const Value* negotiated = member(*config, "params");
    const auto interval = duration_in(negotiated == nullptr ? config : negotiated, "interval");
    return interval && *interval > base::Duration{} ? interval : std::nullopt;
}

Measurement measurement_of(const std::vector<RoundTrip>& trips,
                           std::optional<base::Duration> spacing)
{
    const bool has_ways = std::ranges::all_of(trips, [](const RoundTrip& trip) {
        return trip.fate != TripFate::answered || (trip.send && trip.receive);
    });
    Measurement measurement;
    if (!has_ways) {
        MeasuredWay& way = measurement.round_trip.emplace();
        way.spacing = spacing;
        for (const RoundTrip& trip : trips) way.add(trip.whole, trip.fate != TripFate::answered);
        return measurement;
    }
    measurement.mixes_losses = std::ranges::count(trips, TripFate::lost, &RoundTrip::fate) > 0;
    MeasuredWay& up = measurement.up.emplace();
    MeasuredWay& down = measurement.down.emplace();
    up.spacing = down.spacing = spacing;
    for (const RoundTrip& trip : trips) {
        const bool is_lost = trip.fate != TripFate::answered;
        const bool is_lost_up = measurement.mixes_losses ? is_lost : trip.fate == TripFate::lost_up;
        up.add(trip.send, is_lost_up);
        if (!is_lost_up || measurement.mixes_losses) down.add(trip.receive, is_lost);
    }
    settle_clocks(measurement);
    return measurement;
}

} // namespace

base::Result<Measurement> read_irtt(std::string_view text)
{
    Value json;
    try {
        json = Value::parse(text);
    } catch (const Value::parse_error& error) {
        return base::fail(
            fmt::format("line {}: this is not JSON", base::line_number_at(text, error.byte)));
    } catch (const Value::exception&) {
        return base::fail("line 1: this is not JSON: a number is too large");
    }
    const Value* list = member(json, "round_trips");
    if (list == nullptr || !list->is_array()) {
        return base::fail(R"(line 1: no list "round_trips": of JSON, that of irtt can be read)");
    }
    if (list->size() > trace_rows_max) {
        return base::fail(fmt::format("line 1: {}", too_many_values));
    }
    std::vector<RoundTrip> trips;
    for (const Value& entry : *list) {
        const auto trip = round_trip_in(entry);
        if (!trip) {
            return base::fail(fmt::format("line 1: entry {} of round_trips: {}", trips.size() + 1,
                                          trip.error().message));
        }
        trips.push_back(*trip);
    }
    if (trips.empty()) return base::fail("line 1: round_trips is empty");
    return measurement_of(trips, spacing_in(json));
}

} // namespace hapnet::emulator::tools
