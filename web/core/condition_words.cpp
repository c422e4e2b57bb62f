// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/condition_words.hpp"

#include <cstddef>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::web {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t named_max = 3;
constexpr const char* not_set = "none";

Json object_member(const Json& of, const char* key)
{
    const auto found = of.is_object() ? of.find(key) : of.end();
    return found != of.end() && found->is_object() ? *found : Json::object();
}

/// Returns the settings with one key for up and down where their texts are the same.
Json joined(const Json& settings)
{
    Json all = Json::object();
    for (const auto& [key, text] : settings.items()) {
        const bool is_up = key.starts_with("up.");
        if (!is_up && !key.starts_with("down.")) {
            all[key] = text;
            continue;
        }
        const std::string name = key.substr(key.find('.') + 1);
        const auto other = settings.find((is_up ? "down." : "up.") + name);
        const bool is_shared = other != settings.end() && *other == text;
        all[is_shared ? "both." + name : key] = text;
    }
    return all;
}

/// Returns the settings of `after` that `before` lacks or has with another text; `none` stands for
/// a setting that only `before` has.
Json difference(const Json& before, const Json& after)
{
    Json changed = Json::object();
    for (const auto& [key, text] : after.items()) {
        const auto old = before.find(key);
        if (old == before.end() || *old != text) changed[key] = text;
    }
    for (const auto& [key, text] : before.items()) {
        if (!after.contains(key)) changed[key] = not_set;
    }
    return changed;
}

/// Returns a number of the reply's timeline; nullopt for none.
std::optional<double> timeline_s(const Json& shown, const char* key)
{
    const Json timeline = object_member(shown, "timeline");
    const auto found = timeline.find(key);
    if (found == timeline.end() || !found->is_number()) return std::nullopt;
    return found->get<double>();
}

/// Returns true if a change of the timeline was due between the two replies.
bool was_due(const Json& before, const Json& after)
{
    constexpr double tolerance_s = 1e-6; // the replies round their times
    const auto from = timeline_s(before, "position_s");
    const auto left = timeline_s(before, "next_change_in_s");
    const auto to = timeline_s(after, "position_s");
    return from && left && to && *to >= *from + *left - tolerance_s;
}

/// Returns the settings that programs have made and that are still in force, without the time that
/// they have left.
std::vector<Json> live_settings(const Json& shown)
{
    std::vector<Json> all;
    const auto found = shown.is_object() ? shown.find("live") : shown.end();
    if (found == shown.end() || !found->is_array()) return all;
    for (const Json& one : *found) all.push_back(object_member(one, "settings"));
    return all;
}

const char* cause_of(const Json& before, const Json& after)
{
    const auto old = live_settings(before);
    const auto now = live_settings(after);
    if (now.size() < old.size()) return "a setting has ended";
    return now == old && was_due(before, after) ? "the timeline" : "another program";
}

} // namespace

std::string words_of(const Json& settings)
{
    if (!settings.is_object()) return {};
    const Json all = joined(settings);
    std::string words;
    std::size_t named = 0;
    for (const auto& [key, text] : all.items()) {
        if (named == named_max) break;
        words += fmt::format("{}{} {}", named > 0 ? ", " : "", key,
                             text.is_string() ? text.get<std::string>() : text.dump());
        ++named;
    }
    if (all.size() > named) words += fmt::format(" and {} more", all.size() - named);
    return words;
}

std::string words_of_change(const Json& before, const Json& after)
{
    const char* const cause = cause_of(before, after);
    const auto words = words_of(
        difference(object_member(before, "conditions"), object_member(after, "conditions")));
    return words.empty() ? cause : fmt::format("{}: {}", cause, words);
}

} // namespace hapnet::web
