// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/control/core/request.hpp"

#include "proto/base/text.hpp"

#include <algorithm>
#include <set>
#include <spdlog/fmt/fmt.h>

namespace hapnet::control {

namespace {

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

constexpr base::Duration frames_usual = 20ms;
constexpr base::Duration frames_most = 1s;

/// Refuses dangerous or ambiguous input during parsing.
class Guard {
public:
    /// A callback of the parser. The value is skipped if it returns false.
    bool on_event(int depth, Json::parse_event_t event, const Json& value)
    {
        if (error_) return false;
        if (depth > static_cast<int>(nesting_max)) {
            fail("nested too deeply");
            return false;
        }
        const bool is_whole = event == Json::parse_event_t::value ||
                              event == Json::parse_event_t::object_start ||
                              event == Json::parse_event_t::array_start;
        if (is_whole && ++values_ > values_max) {
            fail(fmt::format("more than {} values", values_max));
            return false;
        }
        if (event == Json::parse_event_t::object_start) keys_.emplace_back();
        if (event == Json::parse_event_t::object_end) keys_.pop_back();
        if (event == Json::parse_event_t::key && !keys_.back().insert(value).second) {
            fail(fmt::format("'{}' stands twice", value.get_ref<const std::string&>()));
        }
        return !error_;
    }

    [[nodiscard]] const std::optional<std::string>& error() const { return error_; }

private:
    void fail(std::string what)
    {
        if (!error_) error_ = std::move(what);
    }

    std::vector<std::set<std::string>> keys_; // keys of the open objects, by nesting
    std::size_t values_ = 0;
    std::optional<std::string> error_;
};

} // namespace

base::Result<Json> parse_object(std::string_view line)
{
    Guard guard;
    const auto json = Json::parse(
        line,
        [&](int depth, Json::parse_event_t event, const Json& value) {
            return guard.on_event(depth, event, value);
        },
        /*allow_exceptions*/ false);
    if (guard.error()) return base::fail(*guard.error());
    if (!json.is_object()) {
        return base::fail("not a JSON object on one line, such as {\"command\":\"show\"}");
    }
    return json;
}

std::string Members::text(const char* key)
{
    auto value = optional_text(key);
    if (!value) fail(fmt::format("\"{}\" is missing", key));
    return value.value_or("");
}

std::optional<std::string> Members::optional_text(const char* key)
{
    const auto* value = find(key);
    if (value == nullptr) return std::nullopt;
    if (!value->is_string()) {
        fail(fmt::format("\"{}\" must be a string", key));
        return std::nullopt;
    }
    return value->get<std::string>();
}

std::optional<base::Duration> Members::time(const char* key, base::Duration least,
                                            base::Duration most)
{
    const auto text = optional_text(key);
    if (!text) return std::nullopt;
    const auto value = base::parse_duration(*text);
    if (!value) {
        fail(fmt::format("\"{}\": {}", key, value.error().message));
    } else if (*value < least || *value > most) {
        fail(fmt::format("\"{}\": '{}' is out of range: use {} to {}", key, *text,
                         base::bound_text(least), base::bound_text(most)));
    } else {
        return *value;
    }
    return std::nullopt;
}

const Json* Members::find(const char* key)
{
    known_.emplace_back(key);
    const auto found = json_.find(key);
    return found == json_.end() ? nullptr : &*found;
}

void Members::fail(std::string what)
{
    if (!error_) error_ = std::move(what);
}

void Members::refuse_the_rest()
{
    for (const auto& [name, value] : json_.items()) {
        if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
        fail(fmt::format("\"{}\" is not known here; known are: {}", name, fmt::join(known_, ", ")));
    }
}

WaitRequest wait_request(Members& members)
{
    auto until = base::parse_condition(members.text("until"));
    if (!until) members.fail(std::move(until.error().message));
    return {until ? *std::move(until) : base::Condition{}, members.time("timeout", 0ms)};
}

WatchRequest watch_request(Members& members, base::Duration frames_least)
{
    const auto what = members.optional_text("what").value_or("statistics");
    if (what == "frames") {
        return {members.time("every", frames_least, frames_most).value_or(frames_usual), true};
    }
    if (what != "statistics") members.fail("\"what\" must be statistics or frames");
    return {members.time("every", 50ms).value_or(WatchRequest{}.every)};
}

KeepRequest keep_request(Members& members, std::optional<base::Duration> held)
{
    constexpr std::string_view characters = "abcdefghijklmnopqrstuvwxyz0123456789-";
    KeepRequest request{members.text("name"), std::nullopt};
    const bool fits = !request.name.empty() && request.name.size() <= KeepRequest::name_max &&
                      request.name.find_first_not_of(characters) == std::string::npos;
    if (!fits) {
        members.fail(fmt::format("\"name\" must be 1 to {} characters of a-z, 0-9 and -",
                                 KeepRequest::name_max));
    }
    if (!held) members.fail("nothing is kept in memory: start it with --keep TIME --keep-in DIR");
    request.last = members.time("last", 1ms, held.value_or(24h));
    return request;
}

} // namespace hapnet::control
