// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/control/core/reply.hpp"

namespace hapnet::control {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t error_bytes_max = 2000;

} // namespace

std::string line_of(const Json& json)
{
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string refusal(std::string_view error)
{
    std::string text{error.substr(0, error_bytes_max)};
    if (text.size() < error.size()) text += "...";
    return line_of(Json{{"ok", false}, {"error", text}});
}

std::string busy_refusal()
{
    return line_of(Json{{"ok", false},
                        {"busy", true},
                        {"error", "too many clients are connected; try again when one has gone"}});
}

std::string statistics_reply(const Json& statistics)
{
    Json reply{{"ok", true}};
    reply.update(statistics);
    return line_of(reply);
}

std::string wait_reply(const base::Condition& until, bool is_met, const Json& statistics)
{
    Json reply{{"ok", true}, {"until", to_text(until)}, {"met", is_met}};
    for (const char* key : {"generation", "elapsed_s"}) {
        if (statistics.contains(key)) reply[key] = statistics[key];
    }
    return line_of(reply);
}

std::string keep_reply(const base::Result<std::string>& file, base::TimePoint from,
                       base::TimePoint to)
{
    if (!file) return refusal(file.error().message);
    return line_of(Json{{"ok", true},
                        {"file", *file},
                        {"from_ns", from.time_since_epoch().count()},
                        {"to_ns", to.time_since_epoch().count()}});
}

} // namespace hapnet::control
