// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/control/request.hpp"

#include "proto/base/text.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json; // settings count in the order in which they stand

/// Refuses while it is read what would be dangerous or ambiguous once it has been.
class Guard {
public:
    /// A callback of the parser: false skips the value.
    bool on_event(int depth, Json::parse_event_t event, const Json& value)
    {
        if (error_) return false;
        if (depth > static_cast<int>(nesting_max)) {
            fail("nested too deeply");
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

    std::vector<std::set<std::string>> keys_; // of the objects that are open
    std::optional<std::string> error_;
};

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

/// The members of a request; the first trouble is remembered.
class Members {
public:
    explicit Members(const Json& json) : json_{json} {}

    /// A text that must be there.
    std::string text(const char* key)
    {
        auto value = optional_text(key);
        if (!value) fail(fmt::format("\"{}\" is missing", key));
        return value.value_or("");
    }

    std::optional<std::string> optional_text(const char* key)
    {
        const auto* value = find(key);
        if (value == nullptr) return std::nullopt;
        if (!value->is_string()) {
            fail(fmt::format("\"{}\" must be a text in quotes", key));
            return std::nullopt;
        }
        return value->get<std::string>();
    }

    /// A time from `least` to a day.
    std::optional<base::Duration> time(const char* key, base::Duration least)
    {
        const auto text = optional_text(key);
        if (!text) return std::nullopt;
        const auto value = base::parse_duration(*text);
        if (!value) {
            fail(fmt::format("\"{}\": {}", key, value.error().message));
        } else if (*value < least || *value > 24h) {
            fail(fmt::format("\"{}\": '{}' is not from {} to 24 hours", key, *text,
                             base::to_text(least)));
        } else {
            return *value;
        }
        return std::nullopt;
    }

    std::vector<SettingText> settings(const char* key)
    {
        std::vector<SettingText> settings;
        const auto* value = find(key);
        if (value == nullptr || !value->is_object() || value->empty()) {
            fail(fmt::format("\"{}\" must be an object such as {{\"both.delay\":\"80ms\"}}", key));
            return settings;
        }
        if (value->size() > settings_max) fail(fmt::format("more than {} settings", settings_max));
        for (const auto& [name, text] : value->items()) {
            if (!text.is_string()) {
                fail(fmt::format("the value of \"{}\" must be a text in quotes", name));
                break;
            }
            settings.emplace_back(name, text.get<std::string>());
        }
        return settings;
    }

    template <typename Value>
    Value take(base::Result<Value> value, Value otherwise)
    {
        if (value) return *std::move(value);
        fail(std::move(value.error().message));
        return otherwise;
    }

    [[nodiscard]] const std::optional<std::string>& error() const { return error_; }

    /// The request, if nothing was wrong and nothing is left over.
    base::Result<Request> finish(Request request)
    {
        for (const auto& [name, value] : json_.items()) {
            if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
            fail(fmt::format("\"{}\" is not known here; known are: {}", name,
                             fmt::join(known_, ", ")));
        }
        if (error_) return base::fail(*error_);
        return request;
    }

private:
    const Json* find(const char* key)
    {
        known_.emplace_back(key);
        const auto found = json_.find(key);
        return found == json_.end() ? nullptr : &*found;
    }

    void fail(std::string what)
    {
        if (!error_) error_ = std::move(what);
    }

    const Json& json_;
    std::vector<std::string_view> known_;
    std::optional<std::string> error_;
};

ProfileText profile_of(Members& members)
{
    auto toml = members.text("profile");
    return {std::move(toml), members.optional_text("file").value_or("profile")};
}

Request request_of(std::string_view command, Members& members)
{
    if (command == "set") {
        auto settings = members.settings("settings");
        return SetRequest{std::move(settings), members.time("for", 1ms)};
    }
    if (command == "apply") return ApplyRequest{profile_of(members)};
    if (command == "diff") return DiffRequest{profile_of(members)};
    if (command == "reset") return ResetRequest{};
    if (command == "stats") return StatsRequest{};
    if (command == "wait") {
        auto until = members.take(parse_condition(members.text("until")), Condition{});
        return WaitRequest{std::move(until), members.time("timeout", 0ms)};
    }
    if (command == "watch") return WatchRequest{members.time("every", 50ms).value_or(500ms)};
    return ShowRequest{};
}

} // namespace

base::Result<Request> parse_request(std::string_view line)
{
    constexpr std::array<std::string_view, 8> commands{"show",  "set",   "apply", "diff",
                                                       "reset", "stats", "wait",  "watch"};
    const auto json = parse_object(line);
    if (!json) return tl::unexpected{json.error()};
    Members members{*json};
    const std::string command = members.text("command");
    if (members.error()) return base::fail(*members.error());
    if (std::find(commands.begin(), commands.end(), command) == commands.end()) {
        return base::fail(fmt::format("\"command\" must be one of {}", fmt::join(commands, ", ")));
    }
    return members.finish(request_of(command, members));
}

} // namespace hapnet::emulator
